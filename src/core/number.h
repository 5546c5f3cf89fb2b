// SPDX-License-Identifier: GPL-3.0-or-later
// Comparisons of the inner loops, where a call of fmax costs more than the rest.
#ifndef JOSTLE_NUMBER_H
#define JOSTLE_NUMBER_H

#include <stdint.h>
#include <string.h>

// Not for NaN, as the next one.
static inline double number_max(double a, double b) {
    return a > b ? a : b;
}

static inline double number_min(double a, double b) {
    return a < b ? a : b;
}

// Of whole numbers.
static inline long number_least(long a, long b) {
    return a < b ? a : b;
}

static inline int64_t number_bits(double x) {
    int64_t b;
    memcpy(&b, &x, sizeof b);
    return b;
}

// Negative if |x| > limit >= 0, by the sign of bits(limit) - bits(|x|): numbers that are not
// negative stand in the order of their bits, and what is not a number stands above all.
static inline int64_t number_beyond(double x, double limit) {
    return number_bits(limit) - (number_bits(x) & INT64_MAX);
}

#endif
