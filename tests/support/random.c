// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random.h"

#include <math.h>

// SplitMix64: Steele, Lea & Flood (2014), OOPSLA.
static uint64_t next(struct random *r) {
    uint64_t z = r->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

double random_uniform(struct random *r, double from, double to) {
    return from + (to - from) * (double)(next(r) >> 11) * 0x1p-53;
}

double random_logarithmic(struct random *r, double from, double to) {
    return exp(random_uniform(r, log(from), log(to)));
}

int random_below(struct random *r, int n) {
    return (int)(next(r) % (uint64_t)n);
}
