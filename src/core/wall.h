// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_WALL_H
#define JOSTLE_WALL_H

#include <time.h>

// Time [s] of a monotonic clock, which is never set. Only differences have a meaning.
static inline double wall_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// The time since 1970 [s].
static inline double wall_date(void) {
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
