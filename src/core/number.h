// SPDX-License-Identifier: GPL-3.0-or-later
// Comparisons for inner loops, in which a call of fmax costs more than the other operations.
#ifndef JOSTLE_NUMBER_H
#define JOSTLE_NUMBER_H

#include <stdint.h>
#include <string.h>

// The larger of two numbers; not for NaN.
static inline double number_max(double a, double b) {
    return a > b ? a : b;
}

// The smaller of two numbers; not for NaN.
static inline double number_min(double a, double b) {
    return a < b ? a : b;
}

// The smaller of two whole numbers.
static inline long number_least(long a, long b) {
    return a < b ? a : b;
}

// The bits of a double.
static inline int64_t number_bits(double x) {
    int64_t b;
    memcpy(&b, &x, sizeof b);
    return b;
}

#endif
