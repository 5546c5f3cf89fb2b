// SPDX-License-Identifier: GPL-3.0-or-later
// Tridiagonal solves of up to eight buildings of the same height in lanes.
//
// A solve is two chains, each value waiting for the one before,
//     x_i = r_i - l_(i-1) x_(i-1) upwards,   y_i = x_i / d_i - l_i y_(i+1) downwards,
// so one building cannot be spread over lanes, but eight can share them: squares of four floors of
// four buildings are transposed on the way in and out; the factors are held that way. While four
// wait for one another, the other four go on.
#include "solve/floors/effective.h"

enum { FOUR = LANES_VECTOR, FOURS = EFFECTIVE_ABREAST / FOUR };

// Floors i to i + 3 of four arrays; lane k of row j is floor i + j of array k.
LANES_INLINE void load(const double *const x[FOUR], int i, lanes row[FOUR]) {
    for (int k = 0; k < FOUR; k++) {
        row[k] = *(const lanes *)(x[k] + i);
    }
    lanes_transpose(row);
}

LANES_INLINE void load_floor(const double *const x[FOUR], int i, lanes *row) {
    *row = (lanes){x[0][i], x[1][i], x[2][i], x[3][i]};
}

// Backwards, as the last building stands in the lanes beyond it too.
LANES_INLINE void store(double *const q[FOUR], int i, lanes row[FOUR]) {
    lanes_transpose(row);
    for (int k = FOUR - 1; k >= 0; k--) {
        *(lanes *)(q[k] + i) = 0.0 + row[k];
    }
}

LANES_INLINE void store_floor(double *const q[FOUR], int i, const lanes *row) {
    for (int k = FOUR - 1; k >= 0; k--) {
        q[k][i] = 0.0 + (*row)[k];
    }
}

// Where the floors of each begin; those that there are not are the last one again.
struct abreast {
    const double *r[EFFECTIVE_ABREAST], *factor, *pivot;
    double *q[EFFECTIVE_ABREAST];
};

LANES_INLINE struct abreast gather(const struct effective *e, const double *r, double *q) {
    struct abreast b = {.factor = e->factor, .pivot = e->pivot};
    for (int k = 0; k < EFFECTIVE_ABREAST; k++) {
        const ptrdiff_t own = k < e->abreast ? k : e->abreast - 1;
        b.r[k] = r + own * e->building->n_floor;
        b.q[k] = q + own * e->building->n_floor;
    }
    return b;
}

// The factors of floor i of four buildings, the j-th four.
#define HELD(x, i, j)                                                                              \
    (*(const lanes *)((x) + (ptrdiff_t)(i)*EFFECTIVE_ABREAST + (ptrdiff_t)(j)*FOUR))

LANES_INLINE void upwards(const struct abreast *b, int n, lanes (*restrict x)[FOURS]) {
    int i = 0;
    lanes carried[FOURS] = {{0.0}};
    for (; i + FOUR <= n; i += FOUR) {
        lanes in[FOURS][FOUR];
        for (int j = 0; j < FOURS; j++) {
            load(b->r + (ptrdiff_t)j * FOUR, i, in[j]);
        }
        for (int k = 0; k < FOUR * FOURS; k++) {
            const int j = k % FOURS, row = k / FOURS, f = i + row;
            x[f][j] = in[j][row] - carried[j];
            carried[j] = HELD(b->factor, f, j) * x[f][j];
        }
    }
    for (; i < n; i++) {
        for (int j = 0; j < FOURS; j++) {
            lanes in;
            load_floor(b->r + (ptrdiff_t)j * FOUR, i, &in);
            x[i][j] = in - carried[j];
            carried[j] = HELD(b->factor, i, j) * x[i][j];
        }
    }
}

LANES_INLINE void downwards(const struct abreast *b, int n, lanes (*restrict x)[FOURS]) {
    int i = n;
    lanes last[FOURS] = {{0.0}};
    for (; i >= FOUR; i -= FOUR) {
        lanes y[FOURS][FOUR];
        for (int k = FOUR * FOURS - 1; k >= 0; k--) {
            const int j = k % FOURS, row = k / FOURS, f = i - FOUR + row;
            y[j][row] = last[j] = x[f][j] * HELD(b->pivot, f, j) - HELD(b->factor, f, j) * last[j];
        }
        for (int j = FOURS - 1; j >= 0; j--) {
            store(b->q + (ptrdiff_t)j * FOUR, i - FOUR, y[j]);
        }
    }
    while (i-- > 0) {
        for (int j = FOURS - 1; j >= 0; j--) {
            last[j] = x[i][j] * HELD(b->pivot, i, j) - HELD(b->factor, i, j) * last[j];
            store_floor(b->q + (ptrdiff_t)j * FOUR, i, &last[j]);
        }
    }
}

LANES void effective_solve_abreast(const struct effective *e, const double *r, double *q) {
    const struct abreast b = gather(e, r, q);
    const int n = e->building->n_floor;
    lanes(*x)[FOURS] = (lanes(*)[FOURS])e->between;
    upwards(&b, n, x);
    downwards(&b, n, x);
}
