// SPDX-License-Identifier: GPL-3.0-or-later
// The effective mass matrix of one building under Newmark, factorised:
//     A = M + gamma h C + beta h^2 K,   A a = r.
// It is tridiagonal for a shear building, and full with modal damping. Buildings never share a
// matrix: contact forces couple them through columns of A^-1.
#ifndef JOSTLE_EFFECTIVE_H
#define JOSTLE_EFFECTIVE_H

#include <assert.h>
#include <stddef.h>

#include "core/lanes.h"
#include "jostle/model.h"

// How long a factorisation will serve.
enum effective_use {
    EFFECTIVE_BRIEFLY,  // a step or so: solves go through the factors
    EFFECTIVE_LONG,     // solves of low buildings multiply by the inverse
};

enum { INVERSE_FLOORS_MAX = 16, EFFECTIVE_ABREAST = LANES_WIDTH };

struct effective {
    const struct building *building;  // borrowed
    enum effective_use use;
    double b, g;             // beta h^2 and gamma h of the factors; NAN: none
    double *tangent;         // [F/L] (n_floor) storey tangents it was factorised with
    double *pivot, *factor;  // (n_floor) 1/d_i and l_i of A = L D L^T, `pitch` apart; tridiagonal
    int pitch;               // those of neighbours of one height lie side by side
    int abreast;             // so many from this one on are solved together; 0: none
    int stride;              // of the rows of `inverse`: n_floor in whole lanes
    double *inverse;         // (stride, stride) A^-1, rows ready where marked, and zeros
    bool *ready;             // (n_floor) row of `inverse` is valid
    int n_ready;             // rows below this are
    struct reach {
        int from, to;  // in whole lanes
    } * reach;         // (n_floor) of ready rows: entries outside are below rounding
};

// Room for the factors of n buildings of a row, with the initial tangents; false: no memory.
bool effective_alloc(struct effective *e, const struct building *building, int n,
                     enum effective_use use, struct arena *a);

// How many of n buildings, from the first on, have one height, so that they may be solved together.
int effective_alike(const struct building *building, int n);

// Factorises A for beta h^2 = `b`, gamma h = `g` and the tangents of `e`. STATUS_RETRY: A is not
// positive definite to working accuracy.
int effective_factor(struct effective *e, double b, double g);

// Whether solves multiply by the inverse, once it is there.
static inline bool effective_prefers_inverse(const struct effective *e) {
    return e->use == EFFECTIVE_LONG &&
           (e->building->damping_full || e->building->n_floor <= INVERSE_FLOORS_MAX);
}

static inline bool effective_has_inverse(const struct effective *e) {
    return e->n_ready == e->building->n_floor && effective_prefers_inverse(e);
}

static inline bool effective_is_low(const struct effective *e) {
    return e->stride <= INVERSE_FLOORS_MAX && effective_has_inverse(e);
}

// q = A^-1 r by the inverse, for at most LANES_WIDTH floors. Rows and columns beyond it are 0.
LANES_INLINE void effective_multiply_low(const double *inverse, const double *r, double *q) {
    lanes_wide sum = {0.0};
    for (int i = 0; i < LANES_WIDTH; i++) {
        sum += r[i] * LANES_AT(inverse, (ptrdiff_t)i * LANES_WIDTH);
    }
    *(lanes_wide *)q = sum;
}

// For n floors, at most twice as many: `most` columns, at least n and a constant. What would be
// rows and columns beyond is 0.
LANES_INLINE void effective_multiply_high(const double *inverse, int n, int most, const double *r,
                                          double *q) {
    enum { STRIDE = 2 * LANES_WIDTH, VECTORS = STRIDE / LANES_VECTOR };
    lanes sum[VECTORS] = {{0.0}};
    for (int i = 0; i < n; i++, inverse += STRIDE) {
        for (int j = 0; j < most / LANES_VECTOR; j++) {
            sum[j] += r[i] * *(const lanes *)(inverse + (ptrdiff_t)j * LANES_VECTOR);
        }
    }
    for (int j = 0; j < most / LANES_VECTOR; j++) {
        *(lanes *)(q + (ptrdiff_t)j * LANES_VECTOR) = sum[j];
    }
}

// For a low building with its inverse, in whole lanes: what is written beyond q belongs to the next
// building. In line for the loops over floors.
LANES_INLINE void effective_multiply(const struct effective *e, const double *r, double *q) {
    enum { MIDDLE = 3 * LANES_WIDTH / 2 };
    static_assert(INVERSE_FLOORS_MAX <= 2 * LANES_WIDTH, "those are all the strides there are");
    if (e->stride == LANES_WIDTH) {
        effective_multiply_low(e->inverse, r, q);
    } else if (e->building->n_floor <= MIDDLE) {
        effective_multiply_high(e->inverse, e->building->n_floor, MIDDLE, r, q);
    } else {
        effective_multiply_high(e->inverse, e->building->n_floor, INVERSE_FLOORS_MAX, r, q);
    }
}

// The same where registers hold eight numbers.
LANES_INLINE void effective_multiply_wide(const struct effective *e, const double *r, double *q) {
    if (e->stride == LANES_WIDTH) {
        effective_multiply_low(e->inverse, r, q);
        return;
    }
    enum { STRIDE = 2 * LANES_WIDTH };
    lanes_wide low = {0.0}, high = {0.0};
    const double *row = e->inverse;
    for (int i = 0, n = e->building->n_floor; i < n; i++, row += STRIDE) {
        low += r[i] * LANES_AT(row, 0);
        high += r[i] * LANES_AT(row, LANES_WIDTH);
    }
    *(lanes_wide *)q = low;
    *(lanes_wide *)(q + LANES_WIDTH) = high;
}

// q = A^-1 r; both (n_floor), r is overwritten.
void effective_solve(struct effective *e, double *r, double *q);

// The same for n buildings whose floors stand one behind the other in r and q, arrays of
// core/lanes.h: what r has behind them must be finite, and q may be written there. Takes much less
// time than one after the other where they are low, or where several are of the same height.
void effective_solve_row(struct effective *e, int n, double *r, double *q);

// The same for those that are solved together from e[0] on (`abreast`), by their factors.
void effective_solve_abreast(const struct effective *e, const double *r, double *q);

// Column (and row) `i` of A^-1, (n_floor): the accelerations of all floors under a unit force on
// floor i + 1. Computed when first asked for after a factorisation.
const double *effective_column(struct effective *e, int i);

#endif
