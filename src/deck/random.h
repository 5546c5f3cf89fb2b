// SPDX-License-Identifier: GPL-3.0-or-later
// Random values of a parameter. The distribution may be truncated; it is sampled independently or
// by Latin hypercube.
#ifndef JOSTLE_RANDOM_H
#define JOSTLE_RANDOM_H

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

struct random_values {
    const struct distribution *distribution;
    double a, b, min, max;
    enum random_plan plan;
    int n, seed;
    const char *name;  // of the parameter; parameters with the same seed are independent
};

// Draws the values (n). `order` is scratch (n). Value i depends on `r` only; with
// RANDOM_INDEPENDENT it does not depend on n. Errors: STATUS_INPUT (the probability between min and
// max is 0; a value is not finite), STATUS_SYSTEM.
int random_draw(const struct random_values *r, int *order, double *value, struct error *e);

#endif
