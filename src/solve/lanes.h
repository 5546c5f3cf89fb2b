// SPDX-License-Identifier: GPL-3.0-or-later
// Two numbers at a time, with the vector types of gcc and clang: every x86-64 and ARM64 machine has
// registers for them, and elsewhere the compiler takes the numbers apart.
#ifndef JOSTLE_LANES_H
#define JOSTLE_LANES_H

#include <string.h>

enum { LANES = 2 };
struct lanes {
    double x __attribute__((vector_size(LANES * sizeof(double))));
};

// From and to an array, aligned or not: at its start, or lane number n of it.
static inline struct lanes lanes_load(const double *a) {
    struct lanes l;
    memcpy(&l, a, sizeof l);
    return l;
}

static inline void lanes_store(double *a, struct lanes l) {
    memcpy(a, &l, sizeof l);
}

static inline struct lanes lanes_at(const double *a, size_t n) {
    return lanes_load(a + n * LANES);
}

static inline void lanes_put(double *a, size_t n, struct lanes l) {
    lanes_store(a + n * LANES, l);
}

static inline struct lanes lanes_of(double x) {
    return (struct lanes){{x, x}};
}

static inline double lanes_sum(struct lanes l) {
    return l.x[0] + l.x[1];
}

#endif
