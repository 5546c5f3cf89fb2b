// SPDX-License-Identifier: GPL-3.0-or-later
// Root of a function of one variable. Which function to call depends on what is known:
//
//     values                  root_find      Brent's method
//     values and slopes       root_newton    Newton's method, kept within the bracket
//     the sign only           root_halve     bisection
//
// All keep a bracket: the function is not positive at one end and not negative at the other. A
// search in a bracket cannot fail. It finds a root of a continuous function, or a jump through
// zero.
//
// If a value is expensive, or has more results than a number, the caller writes the loop: it
// computes the value at x, gives it to root_narrow, and goes on with the x of root_step.
#ifndef JOSTLE_ROOT_H
#define JOSTLE_ROOT_H

#include <math.h>
#include <stdbool.h>

// Ends low <= high of a bracket. The function has the sign of `rise` (1 or -1) at `high`.
struct root {
    double low, high, rise;
};

static inline double root_middle(const struct root *r) {
    return 0.5 * (r->low + r->high);
}

// Makes x, where the function has the value y, an end of the bracket.
static inline void root_narrow(struct root *r, double x, double y) {
    *(r->rise * y > 0.0 ? &r->high : &r->low) = x;
}

// The next x, from the value y and the slope at x: that of Newton's method, or the middle if
// Newton's is not inside the bracket (Press et al. 1992, Numerical Recipes, section 9.4).
static inline double root_step(const struct root *r, double x, double y, double slope) {
    double next = x - y / slope;
    return next > r->low && next < r->high ? next : root_middle(r);
}

// Makes the middle an end of the bracket. `beyond`: the root is between the middle and `high`. Here
// `high` may be less than `low`.
static inline void root_halve(struct root *r, bool beyond) {
    *(beyond ? &r->low : &r->high) = root_middle(r);
}

// The root of the straight line between the values at both ends: the start of a search.
static inline double root_between(const struct root *r, double at_low, double at_high) {
    double part = at_low / (at_low - at_high);
    return r->low + (r->high - r->low) * fmin(fmax(part, 0.0), 1.0);
}

// The value of a function at x; sets its slope there.
typedef double root_function(double x, void *context, double *slope);

// The root in the bracket by Newton's method, which starts at x and ends at a correction below
// `tolerance`. The error is about the square of this correction. The compiler inlines `function`.
static inline double root_newton(root_function *function, void *context, struct root r, double x,
                                 double tolerance) {
    enum { ITERATIONS_MAX = 100 };
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        double slope;
        double y = function(x, context, &slope);
        if (y == 0.0) {
            return x;
        }
        root_narrow(&r, x, y);
        double next = root_step(&r, x, y, slope);
        if (fabs(next - x) < tolerance) {
            return next;
        }
        x = next;
    }
    return x;
}

// The root of `function` between low and high to the relative tolerance, by Brent's method (GSL).
// The values at low and high must have different signs. NAN: no memory, or the values are not
// finite.
double root_find(double (*function)(double x, void *context), void *context, double low,
                 double high, double tolerance);

#endif
