// SPDX-License-Identifier: GPL-3.0-or-later
// Generalised Richardson extrapolation: f(h) = f + c h^p at the steps h, h / r, h / r^2, with the
// values f1, f2, f3 and their differences d1 = f2 - f1, d2 = f3 - f2, gives
//     p = ln(d1 / d2) / ln r,    f = f3 + D,    D = d2 / (r^p - 1),
// where d1 and d2 have the same sign and |d2| < |d1|.
//
// Error bar U of f3: the grid convergence index of Roache (1998), Verification and Validation in
// Computational Science and Engineering, chapter 5, with the factor of safety F = 1.25 for an order
// that has been observed, 3 for one that has not. For other sequences Eca & Hoekstra (2009),
// Computers & Fluids 38, 1580-1591, put a multiple of the range R = max f - min f of the three
// values in its place:
//     orderly     p up to 0.05 above the method's order     U = F |D|
//     fast        p larger: chance has a hand in it         U = 1.25 R
//     irregular   d1 d2 < 0 or |d2| >= |d1|                 U = 3 R
// They limit F |D| by 1.25 R where p < 0.95; we do not, as a low order is not to look good.
#include "study/convergence.h"

#include <math.h>

static const double ORDER_SLACK = 0.05;
static const double SAFETY_FAST = 1.25, SAFETY_IRREGULAR = 3.0;

// Differences below this share of the value come from rounding, which grows with the number of
// steps.
static const double ROUNDING = 1e-11;

struct convergence convergence_of(const double *value, int n, double ratio, double order,
                                  double safety) {
    const double f1 = value[n - 3], f2 = value[n - 2], f3 = value[n - 1];
    const double d1 = f2 - f1, d2 = f3 - f2;
    const double range = fmax(fmax(f1, f2), f3) - fmin(fmin(f1, f2), f3);
    struct convergence c = {.order = NAN, .estimate = f3, .error = range};
    if (range <= ROUNDING * fabs(f3)) {
        c.kind = CONVERGENCE_NONE;
        return c;
    }
    if (!(d1 * d2 > 0.0) || fabs(d2) >= fabs(d1)) {
        c.kind = CONVERGENCE_IRREGULAR;
        c.error = SAFETY_IRREGULAR * range;
        return c;
    }
    c.order = log(d1 / d2) / log(ratio);
    c.kind = c.order <= order + ORDER_SLACK ? CONVERGENCE_ORDERLY : CONVERGENCE_FAST;
    double step = d2 / (pow(ratio, fmin(c.order, order)) - 1.0);
    c.estimate = f3 + step;
    c.error = c.kind == CONVERGENCE_ORDERLY ? safety * fabs(step) : SAFETY_FAST * range;
    return c;
}

struct convergence convergence_of_count(const double *value, int n) {
    double change = fabs(value[n - 1] - value[n - 2]);
    return (struct convergence){
        .kind = change == 0.0 ? CONVERGENCE_COUNT : CONVERGENCE_MISCOUNT,
        .order = NAN,
        .estimate = value[n - 1],
        .error = change,
    };
}

bool convergence_is_within(const struct convergence *c, double value, double rtol) {
    return c->error <= rtol * fabs(value) && c->kind != CONVERGENCE_MISCOUNT;
}
