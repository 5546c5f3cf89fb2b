// SPDX-License-Identifier: GPL-3.0-or-later
// Intensities of a piecewise linear acceleration a + s x, with the time x since a sample. In one
// step
//     the integral of the square            is dt (a0^2 + a0 a1 + a1^2) / 3,
//     the integral of the absolute value    is dt |a0 + a1| / 2, or if the sign changes
//                                              dt (a0^2 + a1^2) / (2 (|a0| + |a1|)).
// The trapezoidal rule of the samples is larger: by dt (a1 - a0)^2 / 6 in the first, and in the
// second by dt |a0 a1| / (|a0| + |a1|) if the sign changes.
//
// Velocity and displacement have their peaks at samples, or where acceleration or velocity is zero.
//
// Sources: Arias (1970) in Hansen, Seismic Design for Nuclear Power Plants. Significant durations:
// Trifunac and Brady (1975), Bulletin of the Seismological Society of America 65, 581. CAV: EPRI
// NP-5930 (1988), without its threshold.
#include "jostle/intensity.h"

#include <assert.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_poly.h>
#include <math.h>

static void note(double value, double time, double *peak, double *peak_time) {
    if (fabs(value) > *peak) {
        *peak = fabs(value);
        *peak_time = time;
    }
}

static void note_peaks(const struct signal *g, size_t j, struct intensity *out) {
    const double t = (double)j * g->dt, a = g->value[j], v = g->velocity[j];
    const double u = g->displacement[j];
    note(a, t, &out->pga, &out->pga_time);
    note(v, t, &out->pgv, &out->pgv_time);
    note(u, t, &out->pgd, &out->pgd_time);
    if (j + 1 == g->n) {
        return;
    }
    const double slope = (g->value[j + 1] - a) / g->dt;
    const double turn = -a / slope;
    if (turn > 0.0 && turn < g->dt) {
        note(v + a * turn / 2.0, t + turn, &out->pgv, &out->pgv_time);
    }
    double x[2] = {0.0, 0.0};
    const int n = gsl_poly_solve_quadratic(slope / 2.0, a, v, &x[0], &x[1]);
    for (int i = 0; i < n; i++) {
        if (x[i] > 0.0 && x[i] < g->dt) {
            note(u + x[i] * (v + x[i] * (a / 2.0 + x[i] * slope / 6.0)), t + x[i], &out->pgd,
                 &out->pgd_time);
        }
    }
}

static double square_integral(const struct signal *g, size_t j) {
    const double a = g->value[j], b = g->value[j + 1];
    return g->dt * (a * a + a * b + b * b) / 3.0;
}

static double absolute_integral(const struct signal *g, size_t j) {
    const double a = g->value[j], b = g->value[j + 1];
    if (a * b >= 0.0) {
        return g->dt * fabs(a + b) / 2.0;
    }
    return g->dt * (a * a + b * b) / (2.0 * (fabs(a) + fabs(b)));
}

// Time at which the integral of the squared acceleration reaches `target`. Let r be the rest of the
// integral in the last step, and x the time for it: (a + s x)^3 - a^3 = 3 s r. So x = 3 r / (c^2 +
// c a + a^2) with c = a + s x, the cubic root of a^3 + 3 s r.
static double time_of(const struct signal *g, double target) {
    double sum = 0.0;
    for (size_t j = 0; j + 1 < g->n; j++) {
        const double more = square_integral(g, j);
        if (sum + more >= target && more > 0.0) {
            const double a = g->value[j], rest = target - sum;
            const double c = cbrt(a * a * a + 3.0 * (g->value[j + 1] - a) / g->dt * rest);
            const double x = rest > 0.0 ? 3.0 * rest / (c * c + c * a + a * a) : 0.0;
            return (double)j * g->dt + fmin(x, g->dt);
        }
        sum += more;
    }
    return 0.0;
}

struct intensity intensity_of(const struct signal *ground, double gravity) {
    assert(ground && gravity > 0.0);
    struct intensity out = {0};
    double total = 0.0, squares = 0.0;
    for (size_t j = 0; j < ground->n; j++) {
        note_peaks(ground, j, &out);
        if (j + 1 < ground->n) {
            total += square_integral(ground, j);
            out.cav += absolute_integral(ground, j);
            const double a = ground->value[j], b = ground->value[j + 1];
            squares += ground->dt * (a * a + b * b) / 2.0;
            out.cav_trapezoid += ground->dt * (fabs(a) + fabs(b)) / 2.0;
        }
    }
    out.arias = M_PI / (2.0 * gravity) * total;
    out.arias_trapezoid = M_PI / (2.0 * gravity) * squares;
    out.time_5 = time_of(ground, 0.05 * total);
    out.d5_75 = time_of(ground, 0.75 * total) - out.time_5;
    out.d5_95 = time_of(ground, 0.95 * total) - out.time_5;
    return out;
}
