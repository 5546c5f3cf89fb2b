// SPDX-License-Identifier: GPL-3.0-or-later
// The path within a step is the cubic Hermite polynomial in x = t / h,
//     d(x) = d0 + x (m0 + x (3 D - 2 m0 - m1 + x (m0 + m1 - 2 D))),  D = d1 - d0, m = h v,
// whose velocity is right to third order. The zero is bracketed by the ends.
#include "solve/event/crossing.h"

#include <math.h>

#include "core/root.h"

// Of x: a few units of the last place.
static const double PRECISION = 1e-15;

struct cubic {
    double c0, c1, c2, c3;
};

// The cubic, and its slope.
static double crossing_at(double x, void *context, double *slope) {
    const struct cubic *c = context;
    *slope = c->c1 + x * (2.0 * c->c2 + x * 3.0 * c->c3);
    return c->c0 + x * (c->c1 + x * (c->c2 + x * c->c3));
}

static double crossing_root(struct cubic *c, double rise) {
    const struct root r = {0.0, 1.0, rise};
    double slope;
    const double x = c->c0 / (c->c0 - crossing_at(1.0, c, &slope));
    return root_newton(crossing_at, c, r, x > 0.0 && x < 1.0 ? x : root_middle(&r), PRECISION);
}

static struct cubic crossing_cubic(const struct path *p) {
    double m0 = p->h * p->v0;
    double m1 = p->h * p->v1;
    double rise = p->d1 - p->d0;
    return (struct cubic){p->d0, m0, 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise};
}

double crossing_find(const struct path *p, double *velocity) {
    struct cubic c = crossing_cubic(p);
    double x = 1.0;
    if (p->d0 == 0.0 && p->d1 * c.c1 < 0.0) {
        struct cubic other = {c.c1, c.c2, c.c3, 0.0};  // the cubic without its root at x = 0
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
    struct cubic c = crossing_cubic(p);
    double x = c.c1 / (sqrt(c.c2 * c.c2 - 3.0 * c.c3 * c.c1) - c.c2);
    double slope;
    *largest = crossing_at(x, &c, &slope);
    return x * p->h;
}
