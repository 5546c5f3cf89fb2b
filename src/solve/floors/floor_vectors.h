// SPDX-License-Identifier: GPL-3.0-or-later
// The vectors in which steps go over floors, of four numbers, or of eight where FLOORS_WIDE is
// defined. Few processors have registers of eight; on others, what a loop carries from one turn to
// the next would be in memory.
//     vector of floors    neighbouring floors of one run
//     vector of runs      (FLOORS_OF_RUNS) one floor of as many runs: a part of the WIDE_RUNS lanes
// Loops that go from vector to vector are the same for both. They number vectors by their first
// floor. What differs is in this file: where a vector stands in an array, what is next to it, and
// how it reads a number of the model.
//
// A load that spans two recent stores stalls until both are in the cache. So neighbours' values are
// read in a later loop than the one that writes them, or come from registers.
#ifndef JOSTLE_FLOOR_VECTORS_H
#define JOSTLE_FLOOR_VECTORS_H

#include "core/lanes.h"

// FLOORS_CLONES marks functions that are not in line.
#ifdef FLOORS_WIDE
typedef lanes_wide floor_lanes;
typedef lanes_wide_bits floor_bits;
#define FLOORS_CLONES LANES_WHOLE
#else
typedef lanes floor_lanes;
typedef lanes_bits floor_bits;
#define FLOORS_CLONES LANES
#endif

// Numbers in a vector, and vectors in whole lanes.
enum {
    FLOORS_VECTOR = sizeof(floor_lanes) / sizeof(double),
    FLOORS_VECTORS = LANES_WIDTH / FLOORS_VECTOR,
};

// BELOW and ABOVE are the floors one below and one above those of a vector; `under` and `over` are
// the vectors next to it.
#if defined(FLOORS_OF_RUNS)
#define BELOW(under, own) (under)
#define ABOVE(own, over) (over)
#elif defined(FLOORS_WIDE)
#define BELOW(under, own) __builtin_shufflevector(under, own, 7, 8, 9, 10, 11, 12, 13, 14)
#define ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4, 5, 6, 7, 8)
#elif defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define BELOW(under, own) __builtin_shufflevector(under, own, 3, 4, 5, 6)
#define ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4)
#else
#define BELOW(under, own) ((lanes){(under)[3], (own)[0], (own)[1], (own)[2]})
#define ABOVE(own, over) ((lanes){(own)[1], (own)[2], (own)[3], (over)[0]})
#endif

// FLOORS_NEXT   the number of floors from one vector to the next
// floor_number  a number that all floors share: of the one run, or of each run of a vector
// CHAIN_AT      vector i of an array of the chain of `p`; HELD_AT of an array of the model, which
//               has one number for all runs, or one for each
// JOINED        x where floor i stands on another one, else 0: loops over vectors of runs begin at
//               the lowest floor of a building
// FLOORS_SLOT   where floor i adds to a work, in vector j of whole lanes
// FLOORS_HEEDED flags of the lanes that a run is in
//
// Vectors of runs that belong to a floor stand together in memory, MOTION_PITCH of a motion or a
// trial, CHAIN_PITCH numbers of a chain and so on: a loop has few addresses to count up.
#ifdef FLOORS_OF_RUNS
enum { FLOORS_NEXT = 1, FLOORS_WHOLE = 1, FLOORS_PARTS = FLOORS_VECTORS };
enum {
    FLOORS_PITCH = WIDE_RUNS,
    MOTION_PITCH = 3,
    PEAK_PITCH = 5,
    CHAIN_PITCH = 5,
    LINE_PITCH = 4
};
typedef floor_lanes floor_number;
#define HELD_AT(once, x, i)                                                                        \
    ((floor_lanes)((once) ? (floor_lanes)((x)[i] - (floor_lanes){0.0}) : FLOORS_AT(x, i)))
#define CHAIN_AT(p, x, i) HELD_AT((p)->once, (p)->chain.x, (i)*CHAIN_PITCH)
#define JOINED(p, i, x) (x)
#define FLOORS_SLOT(p, i, j) ((ptrdiff_t)((size_t)((p)->first + (i)) % LANES_WIDTH))
#define FLOORS_HEEDED(p, flags) ((flags) & (p)->active)
#else
enum { FLOORS_NEXT = FLOORS_VECTOR, FLOORS_WHOLE = LANES_WIDTH };
enum { FLOORS_PITCH = 1, MOTION_PITCH = 1, PEAK_PITCH = 1, LINE_PITCH = 1 };
typedef double floor_number;
#define CHAIN_AT(p, x, i) FLOORS_AT((p)->chain.x, i)
#define JOINED(p, i, x) (FLOORS_AT((p)->chain.joint, i) * (x))
#define FLOORS_SLOT(p, i, j) ((j)*FLOORS_VECTOR)
#define FLOORS_HEEDED(p, flags) (flags)
#endif

// The vector of floor i of an array, to read and to write; and the same of a motion or a trial, of
// peaks, and of the lines of storeys.
#define FLOORS_AT(x, i) (*(const floor_lanes *)((x) + (ptrdiff_t)(i)*FLOORS_PITCH))
#define FLOORS_SET(x, i) (*(floor_lanes *)((x) + (ptrdiff_t)(i)*FLOORS_PITCH))
#define MOTION_AT(x, i) FLOORS_AT(x, (ptrdiff_t)(i)*MOTION_PITCH)
#define MOTION_SET(x, i) FLOORS_SET(x, (ptrdiff_t)(i)*MOTION_PITCH)
#define PEAK_AT(x, i) FLOORS_AT(x, (ptrdiff_t)(i)*PEAK_PITCH)
#define PEAK_SET(x, i) FLOORS_SET(x, (ptrdiff_t)(i)*PEAK_PITCH)
#define LINE_AT(x, i) FLOORS_AT(x, (ptrdiff_t)(i)*LINE_PITCH)

// For each vector of whole lanes, unrolled so that the vectors stay in registers.
#define EACH_OF_LANES(j)                                                                           \
    _Pragma("GCC unroll 2") for (ptrdiff_t j = 0; j < FLOORS_WHOLE / FLOORS_NEXT; j++)

// Negative where |x| > limit >= 0, by the sign of bits(limit) - bits(|x|). Numbers >= 0 have the
// order of their bits, and the bits of NaN are above those of all numbers.
#define BEYOND(x, limit) ((floor_bits)(limit) - ((floor_bits)(x)&INT64_MAX))

// Is one of them negative?
LANES_INLINE bool floors_any(const floor_bits *sign) {
#ifdef FLOORS_WIDE
    const wide_bits negative = (wide_bits)(*sign >> 63);
    return wide_any(&negative);
#else
    return ((*sign)[0] | (*sign)[1] | (*sign)[2] | (*sign)[3]) < 0;
#endif
}

#ifndef FLOORS_OF_RUNS
// y = x A, for `n` rows and as many columns of a matrix, rows `stride` apart: y_j is the sum of
// x_i A_ij in the order of i, with `adds` after what it was. The number of columns is a constant,
// so the sums are in registers.
LANES_INLINE void floors_add_rows(const double *matrix, int n, ptrdiff_t stride, ptrdiff_t columns,
                                  bool adds, const double *x, double *y) {
    floor_lanes sum[2 * FLOORS_VECTORS] = {{0.0}};
    for (ptrdiff_t j = 0; adds && j < columns / FLOORS_VECTOR; j++) {
        sum[j] = FLOORS_AT(y, j * FLOORS_VECTOR);
    }
    for (int i = 0; i < n; i++, matrix += stride) {
        for (ptrdiff_t j = 0; j < columns / FLOORS_VECTOR; j++) {
            sum[j] += x[i] * FLOORS_AT(matrix, j * FLOORS_VECTOR);
        }
    }
    for (ptrdiff_t j = 0; j < columns / FLOORS_VECTOR; j++) {
        FLOORS_SET(y, j * FLOORS_VECTOR) = sum[j];
    }
}

// The same for the matrix of a building (n, n), in whole lanes with zeros beyond n.
LANES_INLINE void floors_multiply(const double *matrix, int n, bool adds, const double *x,
                                  double *y) {
    enum { LOW = LANES_WIDTH, HIGH = 2 * LANES_WIDTH };
    if (n <= LOW) {
        floors_add_rows(matrix, LOW, LOW, LOW, adds, x, y);
    } else if (n <= HIGH) {
        floors_add_rows(matrix, n, HIGH, HIGH, adds, x, y);
    } else {
        for (int j = 0; j < n; j += LOW) {
            floors_add_rows(matrix + j, n, lanes_whole(n), LOW, adds, x, y + j);
        }
    }
}
#endif

#endif
