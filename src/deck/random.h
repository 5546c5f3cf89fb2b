// SPDX-License-Identifier: GPL-3.0-or-later
// Random values of a parameter. The distribution may be truncated; it is sampled independently or
// by Latin hypercube.
#ifndef JOSTLE_RANDOM_H
#define JOSTLE_RANDOM_H

#include <stdbool.h>

#include "jostle/error.h"

// A distribution with two parameters a and b.
struct distribution {
    const char *name, *arguments;  // "normal", "MEAN SD"
    // Error message about a (*at is 0) or b (*at is 1); NULL: both are valid.
    const char *(*fault)(double a, double b, int *at);
    // The standard normal score z of the value x. NULL: the distribution cannot be truncated.
    double (*score)(double a, double b, double x);
    // The value at the score z or, if `score` is NULL, at the probability z.
    double (*value)(double a, double b, double z);
    const char *pure_b;  // name of b if it has no dimension; NULL: it has that of a
};

extern const struct distribution *const random_distributions[];
extern const int n_random_distribution;

enum random_plan { RANDOM_INDEPENDENT, RANDOM_LATIN };

// The correlation matrix of a parameter with those above it must be positive definite. `weight` is
// the last row of its Cholesky factor, for the parameters from the first one to this one.

struct random_values {
    const struct distribution *distribution;
    double a, b, min, max;
    enum random_plan plan;
    int n, seed;
    const char *name;   // of the parameter; parameters with the same seed are independent
    const char *along;  // name of its dimension
    const struct random_values *before;  // the one above in this dimension; NULL: none
    int n_before;
    const double *correlation;  // (n_before) with those above; NULL: independent of them
    const double *weight;       // (n_before + 1)
};

// Draws the values (n). Value i depends on `r` only; with RANDOM_INDEPENDENT it does not depend on
// n, unless it is correlated with values of RANDOM_LATIN. Errors: STATUS_INPUT (the probability
// between min and max is 0; a value is not finite), STATUS_SYSTEM.
int random_draw(const struct random_values *r, double *value, struct error *e);

// The value below which another one is with the probability u; infinite at the end of a tail.
double random_value(const struct random_values *r, double u);

// Sets the weights (n_before + 1) from the correlations (n_before) with the parameters above.
// False: the matrix is not positive definite.
bool random_correlate(const struct random_values *r, const double *correlation, double *weight);

// Whether `r` is correlated with `other` above it.
bool random_is_correlated(const struct random_values *r, const struct random_values *other);

#endif
