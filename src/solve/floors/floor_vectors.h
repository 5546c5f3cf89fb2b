// SPDX-License-Identifier: GPL-3.0-or-later
// The vectors in which steps go over floors: of four floors, or of eight where FLOORS_WIDE is
// defined. Few processors have registers of eight; on others, what a loop carries from one turn to
// the next would be in memory.
//
// A load that spans two recent stores stalls until both are in the cache. So neighbours' values are
// read in a later loop than the one that writes them, or come from registers.
#ifndef JOSTLE_FLOOR_VECTORS_H
#define JOSTLE_FLOOR_VECTORS_H

#include "core/lanes.h"

// FLOORS_CLONES marks functions that are not in line. BELOW and ABOVE are the floors one below and
// one above those of a vector; `under` and `over` are the vectors next to it.
#ifdef FLOORS_WIDE
typedef lanes_wide floor_lanes;
typedef lanes_wide_bits floor_bits;
#define FLOORS_CLONES LANES_WHOLE
#define BELOW(under, own) __builtin_shufflevector(under, own, 7, 8, 9, 10, 11, 12, 13, 14)
#define ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4, 5, 6, 7, 8)
#else
typedef lanes floor_lanes;
typedef lanes_bits floor_bits;
#define FLOORS_CLONES LANES
#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define BELOW(under, own) __builtin_shufflevector(under, own, 3, 4, 5, 6)
#define ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4)
#else
#define BELOW(under, own) ((lanes){(under)[3], (own)[0], (own)[1], (own)[2]})
#define ABOVE(own, over) ((lanes){(own)[1], (own)[2], (own)[3], (over)[0]})
#endif
#endif

// Floors in a vector, and vectors in whole lanes.
enum {
    FLOORS_VECTOR = sizeof(floor_lanes) / sizeof(double),
    FLOORS_VECTORS = LANES_WIDTH / FLOORS_VECTOR,
};

// The vector of an array from i on.
#define FLOORS_AT(x, i) (*(const floor_lanes *)((x) + (i)))

// For each vector of whole lanes, unrolled so that the vectors stay in registers.
#define EACH_OF_LANES(j) _Pragma("GCC unroll 2") for (ptrdiff_t j = 0; j < FLOORS_VECTORS; j++)

#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define LOWER_HALF(x) __builtin_shufflevector(x, x, 0, 1, 2, 3)
#define UPPER_HALF(x) __builtin_shufflevector(x, x, 4, 5, 6, 7)
#else
#define LOWER_HALF(x) ((lanes_bits){(x)[0], (x)[1], (x)[2], (x)[3]})
#define UPPER_HALF(x) ((lanes_bits){(x)[4], (x)[5], (x)[6], (x)[7]})
#endif

// Negative where |x| > limit >= 0, as number_beyond.
#define BEYOND(x, limit) ((floor_bits)(limit) - ((floor_bits)(x)&INT64_MAX))

// Is one of them negative?
LANES_INLINE bool floors_any_narrow(const lanes_bits *sign) {
    return ((*sign)[0] | (*sign)[1] | (*sign)[2] | (*sign)[3]) < 0;
}

LANES_INLINE bool floors_any_wide(const lanes_wide_bits *sign) {
#ifdef FLOORS_WIDE
    const wide_bits negative = (wide_bits)(*sign >> 63);
    return wide_any(&negative);
#else
    const lanes_bits either = LOWER_HALF(*sign) | UPPER_HALF(*sign);
    return floors_any_narrow(&either);
#endif
}

LANES_INLINE bool floors_any(const floor_bits *sign) {
#ifdef FLOORS_WIDE
    return floors_any_wide(sign);
#else
    return floors_any_narrow(sign);
#endif
}

#endif
