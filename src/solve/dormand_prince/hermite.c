// SPDX-License-Identifier: GPL-3.0-or-later
// Hermite interpolation, Hairer, Norsett & Wanner (1993), Solving Ordinary Differential Equations
// I, section II.6. Roots are bracketed: Newton's steps that leave the bracket are replaced by
// bisection, so a search cannot fail.
#include "solve/dormand_prince/hermite.h"

#include <math.h>
#include <stdbool.h>

enum { ITERATIONS_MAX = 100 };
static const double PRECISION = 1e-9;  // of x; the next correction would be about its square

double hermite_value(const struct polynomial *p, double x) {
    const double *c = p->c;
    return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
}

double hermite_slope(const struct polynomial *p, double x) {
    const double *c = p->c;
    return c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])));
}

double hermite_root(const struct polynomial *p, double low, double high) {
    double start = hermite_value(p, low);
    double end = hermite_value(p, high);
    if (start == 0.0 || start == end) {
        return low;
    }
    double sign = end > start ? 1.0 : -1.0;
    double x = low + (high - low) * fmin(fmax(start / (start - end), 0.0), 1.0);
    for (int i = 0; i < ITERATIONS_MAX && high > low; i++) {
        double y = hermite_value(p, x);
        if (y == 0.0) {
            return x;
        }
        *(sign * y > 0.0 ? &high : &low) = x;
        double next = x - y / hermite_slope(p, x);
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        if (fabs(next - x) < PRECISION) {
            return next;
        }
        x = next;
    }
    return x;
}

struct polynomial hermite_position(const struct motion *m) {
    double c1 = m->h * m->v[0];
    double c2 = m->h * m->h * m->a[0] / 2.0;
    double rise = m->d[1] - m->d[0] - c1 - c2;
    double slope = m->h * m->v[1] - c1 - 2.0 * c2;
    double bend = m->h * m->h * m->a[1] - 2.0 * c2;
    return (struct polynomial){{m->d[0], c1, c2, 10.0 * rise - 4.0 * slope + bend / 2.0,
                                -15.0 * rise + 7.0 * slope - bend,
                                6.0 * rise - 3.0 * slope + bend / 2.0}};
}

struct polynomial hermite_velocity(const struct motion *m) {
    double c1 = m->h * m->a[0];
    double end = m->h * m->a[1];
    double rise = m->v[1] - m->v[0];
    return (struct polynomial){
        {m->v[0], c1, 3.0 * rise - 2.0 * c1 - end, c1 + end - 2.0 * rise, 0.0, 0.0}};
}

int hermite_extrema(const struct polynomial *p, double *at) {
    double a = 3.0 * p->c[3];
    double b = p->c[2];  // a x^2 + 2 b x + c
    double c = p->c[1];
    bool same_sign = c * (a + 2.0 * b + c) > 0.0;
    if (same_sign && b * (a + b) >= 0.0) {
        return 0;  // it is monotone between ends of one sign
    }
    double square = b * b - a * c;
    if (!(square > 0.0)) {
        return 0;
    }
    double q = -(b + copysign(sqrt(square), b));
    double root[2] = {q / a, c / q};
    if (!(root[0] <= root[1])) {
        double first = root[1];
        root[1] = root[0];
        root[0] = first;
    }
    int n = 0;
    for (int i = 0; i < 2; i++) {
        if (root[i] > 0.0 && root[i] < 1.0) {
            at[n++] = root[i];
        }
    }
    return n;
}

int hermite_turns(const struct motion *m, double *at) {
    bool same_sign = m->v[0] * m->v[1] > 0.0;
    if (same_sign && m->v[0] * m->a[0] >= 0.0 && m->v[1] * m->a[1] <= 0.0) {
        return 0;  // no cubic with these ends comes back to zero
    }
    struct polynomial v = hermite_velocity(m);
    double end[TURNS_MAX + 1];
    int n_end = hermite_extrema(&v, end);
    end[n_end++] = 1.0;
    int n = 0;
    double low = 0.0;
    for (int i = 0; i < n_end; i++) {
        if (hermite_value(&v, low) * hermite_value(&v, end[i]) < 0.0) {
            double x = hermite_root(&v, low, end[i]);
            if (x > 0.0 && x < 1.0) {
                at[n++] = x;
            }
        }
        low = end[i];
    }
    return n;
}
