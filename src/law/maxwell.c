// SPDX-License-Identifier: GPL-3.0-or-later
// A spring k and a viscous damper in series have one force:
//     F = k (d - z) = c |w|^a sign(w),    w = dz/dt,
// with the shortening z of the damper. In a step of length h the trapezoidal rule gives z,
//     z = z_0 + h (w_0 + w) / 2.
// With kappa = k h / 2 and S = k (d - z_0 - h w_0 / 2) that is one equation,
//     c |w|^a sign(w) + kappa w = S,
// which has one solution. It is solved for the force where a <= 1, and for w where a > 1, so that
// no slope is infinite.
#include "law/maxwell.h"

#include <float.h>
#include <math.h>

#include "law/bilateral.h"
#include "law/link_law.h"

enum { C = LINK_CONSTANTS, A, N_CONSTANT };

enum { ITERATIONS_MAX = 100 };

const struct row maxwell_rows[MAXWELL_ROWS] = {
    [MAXWELL_STIFFNESS] = {"stiffness", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive,
                           NAN, "stiffness of the spring"},
    [MAXWELL_DASHPOT] = {"dashpot", ROW_NUMBER, ROW_REQUIRED | ROW_PER_VELOCITY_POWER, OF_FORCE,
                         &range_positive, NAN, "damper constant: force at unit velocity"},
    [MAXWELL_EXPONENT] = {"exponent", ROW_NUMBER, ROW_POWER, OF_NONE, &bilateral_exponent, 1.0,
                          "exponent of the velocity in the damper"},
};

static int maxwell_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    constant[LINK_STIFFNESS] = value[MAXWELL_STIFFNESS];
    constant[LINK_DASHPOT] = 0.0;  // none acts from end to end
    constant[LINK_EXPONENT] = 1.0;
    constant[C] = value[MAXWELL_DASHPOT];
    constant[A] = value[MAXWELL_EXPONENT];
    return STATUS_OK;
}

static double maxwell_rate(const double *c, double force) {
    return copysign(pow(fabs(force) / c[C], 1.0 / c[A]), force);
}

// The root of x + b x^p = s for s >= 0 and p >= 1, and dx/ds. Newton's method goes down from an
// upper bound, because the function is convex.
static double maxwell_root(double b, double p, double s, double *slope) {
    double x = b > 0.0 ? fmin(s, pow(s / b, 1.0 / p)) : s;
    *slope = 1.0;
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        const double power = b * pow(x, p - 1.0);
        *slope = 1.0 / (1.0 + p * power);
        const double next = x - (x + power * x - s) * *slope;
        if (!(next < x) || x - next <= DBL_EPSILON * x) {
            break;
        }
        x = next;
    }
    return x;
}

static struct contact_response maxwell_force(const double *c, const double *h, double d, double v) {
    (void)v;
    const double k = c[LINK_STIFFNESS], half = h[MAXWELL_STEP] / 2.0, kappa = k * half;
    const double s = k * (d - h[MAXWELL_CREEP] - half * h[MAXWELL_RATE]);
    struct contact_response r = {.force = s, .dfdd = k};
    double slope;
    if (half == 0.0 || s == 0.0) {
        return r;
    }
    if (c[A] <= 1.0) {
        const double p = 1.0 / c[A];
        r.force = copysign(maxwell_root(kappa * pow(c[C], -p), p, fabs(s), &slope), s);
        r.dfdd = k * slope;
    } else {
        const double w = maxwell_root(c[C] / kappa, c[A], fabs(s) / kappa, &slope);
        r.force = copysign(c[C] * pow(w, c[A]), s);
        r.dfdd = k * (1.0 - slope);
    }
    return r;
}

static void maxwell_commit(const double *c, double *h, double d, double v) {
    const double force = maxwell_force(c, h, d, v).force;
    const double rate = maxwell_rate(c, force);
    h[MAXWELL_CREEP] += h[MAXWELL_STEP] / 2.0 * (h[MAXWELL_RATE] + rate);
    h[MAXWELL_RATE] = rate;
    h[MAXWELL_STEP] = 0.0;
}

static double maxwell_stored(const double *c, const double *h, double d) {
    const double spring = d - h[MAXWELL_CREEP];
    return c[LINK_STIFFNESS] * spring * spring / 2.0;
}

const struct contact_law maxwell_law = {
    .name = "maxwell",
    .summary = "spring and viscous damper in series",
    .formula = "F = k (d - z) = c |dz/dt|^a sign(dz/dt)",
    .source = "Soong & Dargush (1997), Passive Energy Dissipation Systems, section 3.5",
    .remarks = "for a damper in series with its brace; the spring is the stiffness of both",
    .row = maxwell_rows,
    .n_row = MAXWELL_ROWS,
    .n_constant = N_CONSTANT,
    .n_history = MAXWELL_HISTORY,
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_STEP,
    .prepare = maxwell_prepare,
    .force = maxwell_force,
    .commit = maxwell_commit,
    .creep = maxwell_rate,
    .stored = maxwell_stored,
};
