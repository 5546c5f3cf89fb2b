// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/event/hermite.h"

#include <math.h>
#include <stdbool.h>

#include "core/root.h"

// Of x: of zeros in Dormand & Prince's steps, where the next correction would be about its square,
// and of those in Newmark's, which are not improved any more: a few units of the last place.
static const double PRECISION = 1e-9, LAST_PLACES = 1e-15;

static double hermite_at(double x, void *context, double *slope) {
    *slope = hermite_slope(context, x);
    return hermite_value(context, x);
}

double hermite_root(struct polynomial p, double low, double high) {
    double start = hermite_value(&p, low);
    double end = hermite_value(&p, high);
    if (start == 0.0 || start == end) {
        return low;
    }
    const struct root r = {low, high, end > start ? 1.0 : -1.0};
    return root_newton(hermite_at, &p, r, root_between(&r, start, end), PRECISION);
}

int hermite_extrema(const struct polynomial *p, double *at) {
    double a = 3.0 * p->c[3];
    double b = p->c[2];  // a x^2 + 2 b x + c
    double c = p->c[1];
    bool same_sign = c * (a + 2.0 * b + c) > 0.0;
    double square = b * b - a * c;
    if ((same_sign && b * (a + b) >= 0.0) || !(square > 0.0)) {
        return 0;  // it is monotone between ends of one sign, or has no zero
    }
    double q = -(b + copysign(sqrt(square), b));
    const double root[2] = {q / a, c / q};
    const int first = root[0] <= root[1] ? 0 : 1;
    int n = 0;
    for (int i = 0; i < 2; i++) {
        const double x = root[i == 0 ? first : 1 - first];
        if (x > 0.0 && x < 1.0) {
            at[n++] = x;
        }
    }
    return n;
}

// Instants 0 < x < 1 at which the velocity changes its sign, ascending; returns how many.
static int hermite_turns(const struct motion *m, double *at) {
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
            double x = hermite_root(v, low, end[i]);
            if (x > 0.0 && x < 1.0) {
                at[n++] = x;
            }
        }
        low = end[i];
    }
    return n;
}

struct motion_pieces hermite_cut(const struct motion *m) {
    struct motion_pieces s = {.path = hermite_path(m), .n = 1};
    s.n += hermite_turns(m, s.x + 1);
    s.x[0] = 0.0;
    s.x[s.n] = 1.0;
    s.d[0] = m->d[0];
    s.d[s.n] = m->d[1];
    for (int i = 1; i < s.n; i++) {
        s.d[i] = hermite_value(&s.path, s.x[i]);
    }
    return s;
}

// A cubic, and its slope.
static double hermite_cubic_at(double x, void *context, double *slope) {
    const double *c = ((const struct polynomial *)context)->c;
    *slope = c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]);
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

static double hermite_cubic_root(struct polynomial *p, double rise) {
    const struct root r = {0.0, 1.0, rise};
    const double start = p->c[0], x = start / (start - hermite_value(p, 1.0));
    return root_newton(hermite_cubic_at, p, r, x > 0.0 && x < 1.0 ? x : root_middle(&r),
                       LAST_PLACES);
}

static struct polynomial hermite_cubic_of(const struct path *p) {
    return hermite_cubic(p->d0, p->h * p->v0, p->d1, p->h * p->v1);
}

double hermite_crossing(const struct path *p, double *velocity) {
    struct polynomial c = hermite_cubic_of(p);
    double x = 1.0;
    if (p->d0 == 0.0 && p->d1 * c.c[1] < 0.0) {
        struct polynomial other = {{c.c[1], c.c[2], c.c[3]}};  // without its root at x = 0
        x = hermite_cubic_root(&other, p->d1 > 0.0 ? 1.0 : -1.0);
    } else if (p->d0 == 0.0) {
        x = 0.0;
    } else if (p->d1 != 0.0) {
        x = hermite_cubic_root(&c, p->d0 < 0.0 ? 1.0 : -1.0);
    }
    (void)hermite_cubic_at(x, &c, velocity);
    *velocity /= p->h;
    return x * p->h;
}

double hermite_summit(const struct path *p, double *highest) {
    const struct polynomial cubic = hermite_cubic_of(p);
    const double *c = cubic.c;
    const double x = c[1] / (sqrt(c[2] * c[2] - 3.0 * c[3] * c[1]) - c[2]);
    *highest = hermite_value(&cubic, x);
    return x * p->h;
}
