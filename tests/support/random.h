// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers that are the same everywhere.
#ifndef JOSTLE_TEST_RANDOM_H
#define JOSTLE_TEST_RANDOM_H

#include <stdint.h>

// `state` is the seed; any will do.
struct random {
    uint64_t state;
};

// An integer from 0 to n - 1.
int random_below(struct random *r, int n);

// Uniform, or uniform in its logarithm, between `from` and `to`.
double random_uniform(struct random *r, double from, double to);
double random_logarithmic(struct random *r, double from, double to);

#endif
