// SPDX-License-Identifier: GPL-3.0-or-later
// q = A^-1 r of low buildings, by their inverse: q_j is the sum over i of r_i A^-1_ij, in the order
// of i. On the vectors of floor_vectors.h, in line for the loops over floors.
#ifndef JOSTLE_EFFECTIVE_LOW_H
#define JOSTLE_EFFECTIVE_LOW_H

#include <assert.h>
#include <stddef.h>

#include "solve/floors/effective.h"
#include "solve/floors/floor_vectors.h"

// Sums of n rows, over as many columns; those are a constant, so that the sums are in registers.
LANES_INLINE void effective_add_rows(const double *inverse, int n, int stride, int columns,
                                     const double *r, double *q) {
    floor_lanes sum[INVERSE_FLOORS_MAX / FLOORS_VECTOR] = {{0.0}};
    for (int i = 0; i < n; i++, inverse += stride) {
        for (ptrdiff_t j = 0; j < columns / FLOORS_VECTOR; j++) {
            sum[j] += r[i] * FLOORS_AT(inverse, j * FLOORS_VECTOR);
        }
    }
    for (ptrdiff_t j = 0; j < columns / FLOORS_VECTOR; j++) {
        *(floor_lanes *)(q + j * FLOORS_VECTOR) = sum[j];
    }
}

// The product with a matrix of a low building, in whole lanes. Rows and columns beyond its floors
// are 0.
LANES_INLINE void effective_multiply_by(const struct effective *e, const double *matrix,
                                        const double *r, double *q) {
    enum { LOW = LANES_WIDTH, HIGH = 2 * LANES_WIDTH, MIDDLE = LOW + LANES_VECTOR };
    static_assert((int)INVERSE_FLOORS_MAX <= (int)HIGH, "those are all the strides there are");
    const int n = e->building->n_floor;
    if (e->stride == LOW) {
        effective_add_rows(matrix, LOW, LOW, LOW, r, q);
    } else if (n <= MIDDLE && FLOORS_VECTORS > 1) {
        effective_add_rows(matrix, n, HIGH, MIDDLE, r, q);
    } else {
        effective_add_rows(matrix, n, HIGH, HIGH, r, q);
    }
}

// For a low building with its inverse: what is written beyond q belongs to the next building.
LANES_INLINE void effective_multiply(const struct effective *e, const double *r, double *q) {
    effective_multiply_by(e, e->inverse, r, q);
}

#endif
