// SPDX-License-Identifier: GPL-3.0-or-later
// The path within a step is the cubic Hermite polynomial of both ends, whose velocity is right to
// third order. The zero is bracketed by the ends.
#include "solve/event/crossing.h"

#include <math.h>

#include "core/root.h"
#include "solve/event/hermite.h"

// Of x: a few units of the last place.
static const double PRECISION = 1e-15;

// The cubic, and its slope.
static double crossing_at(double x, void *context, double *slope) {
    const double *c = ((const struct polynomial *)context)->c;
    *slope = c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]);
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

static double crossing_root(struct polynomial *p, double rise) {
    const struct root r = {0.0, 1.0, rise};
    const double start = p->c[0], x = start / (start - hermite_value(p, 1.0));
    return root_newton(crossing_at, p, r, x > 0.0 && x < 1.0 ? x : root_middle(&r), PRECISION);
}

static struct polynomial crossing_cubic(const struct path *p) {
    return hermite_cubic(p->d0, p->h * p->v0, p->d1, p->h * p->v1);
}

double crossing_find(const struct path *p, double *velocity) {
    struct polynomial c = crossing_cubic(p);
    double x = 1.0;
    if (p->d0 == 0.0 && p->d1 * c.c[1] < 0.0) {
        struct polynomial other = {{c.c[1], c.c[2], c.c[3]}};  // without its root at x = 0
        x = crossing_root(&other, p->d1 > 0.0 ? 1.0 : -1.0);
    } else if (p->d0 == 0.0) {
        x = 0.0;
    } else if (p->d1 != 0.0) {
        x = crossing_root(&c, p->d0 < 0.0 ? 1.0 : -1.0);
    }
    (void)crossing_at(x, &c, velocity);
    *velocity /= p->h;
    return x * p->h;
}

double crossing_summit(const struct path *p, double *largest) {
    const struct polynomial cubic = crossing_cubic(p);
    const double *c = cubic.c;
    const double x = c[1] / (sqrt(c[2] * c[2] - 3.0 * c[3] * c[1]) - c[2]);
    *largest = hermite_value(&cubic, x);
    return x * p->h;
}
