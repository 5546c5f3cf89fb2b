// SPDX-License-Identifier: GPL-3.0-or-later
// Random values of a parameter: a distribution, perhaps truncated, sampled independently or by
// Latin hypercube.
#ifndef JOSTLE_RANDOM_H
#define JOSTLE_RANDOM_H

#include "jostle/error.h"

// A distribution of two parameters a and b. `u` is a probability, 0 < u < 1; min and max, which may
// be infinite, truncate it: u is then the share of the probability between them.
struct distribution {
    const char *name, *arguments;  // "normal", "MEAN SD"
    // What is wrong with a and b, and with which of them: *at is 0 or 1; NULL: nothing.
    const char *(*fault)(double a, double b, int *at);
    double (*score)(double a, double b, double x);  // of x, by which it is truncated; NULL: never
    double (*value)(double a, double b, double score);  // score NULL: at the probability
    const char *pure_b;  // what b is called where it has no dimension; NULL: that of a
};

extern const struct distribution *const random_distributions[];
extern const int n_random_distribution;

enum random_plan { RANDOM_INDEPENDENT, RANDOM_LATIN };

struct random_values {
    const struct distribution *distribution;
    double a, b, min, max;
    enum random_plan plan;
    int n, seed;
    const char *name;  // of the parameter: parameters of one seed are independent of each other
};

// The values (n). `order` is scratch (n). Value i depends on `r` only and, when independent, not on
// n. Errors: STATUS_INPUT (nothing lies between min and max; a value is not finite), STATUS_SYSTEM.
int random_draw(const struct random_values *r, int *order, double *value, struct error *e);

#endif
