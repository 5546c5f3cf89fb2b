// SPDX-License-Identifier: GPL-3.0-or-later
// A solve is two chains, each value waiting for the one before,
//     x_i = r_i - l_(i-1) x_(i-1) upwards,   y_i = x_i / d_i - l_i y_(i+1) downwards,
// so one building cannot be spread over lanes, but four can share them: squares of four floors of
// each are transposed on the way in and out.
#include "solve/four.h"

#include "core/lanes.h"

enum { FOUR = 4 };

// Rows become columns.
LANES_INLINE void transpose(lanes x[FOUR]) {
    lanes a = x[0], b = x[1], c = x[2], d = x[3];
#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
    lanes ab0 = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    lanes ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    lanes cd0 = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    lanes cd1 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    x[0] = __builtin_shufflevector(ab0, cd0, 0, 1, 4, 5);
    x[1] = __builtin_shufflevector(ab1, cd1, 0, 1, 4, 5);
    x[2] = __builtin_shufflevector(ab0, cd0, 2, 3, 6, 7);
    x[3] = __builtin_shufflevector(ab1, cd1, 2, 3, 6, 7);
#else
    for (int i = 0; i < FOUR; i++) {
        x[i] = (lanes){a[i], b[i], c[i], d[i]};
    }
#endif
}

// Floors i to i + 3 of four arrays; lane k of row j is floor i + j of array k.
LANES_INLINE void load(const double *const x[FOUR], int i, lanes row[FOUR]) {
    for (int k = 0; k < FOUR; k++) {
        row[k] = *(const lanes *)(x[k] + i);
    }
    transpose(row);
}

LANES_INLINE void load_floor(const double *const x[FOUR], int i, lanes *row) {
    *row = (lanes){x[0][i], x[1][i], x[2][i], x[3][i]};
}

LANES_INLINE void store(double *const q[FOUR], int i, lanes row[FOUR]) {
    transpose(row);
    for (int k = 0; k < FOUR; k++) {
        *(lanes *)(q[k] + i) = 0.0 + row[k];
    }
}

LANES_INLINE void upwards(const double *const r[FOUR], const double *const l[FOUR], int n,
                          lanes *restrict x) {
    int i = 1;
    lanes last;
    load_floor(r, 0, &last);
    x[0] = last;
    for (; i + FOUR <= n; i += FOUR) {
        lanes in[FOUR], below[FOUR];
        load(r, i, in);
        load(l, i - 1, below);
        for (int j = 0; j < FOUR; j++) {
            x[i + j] = last = in[j] - below[j] * last;
        }
    }
    for (; i < n; i++) {
        lanes in, below;
        load_floor(r, i, &in);
        load_floor(l, i - 1, &below);
        x[i] = last = in - below * last;
    }
}

LANES_INLINE void downwards(const double *const p[FOUR], const double *const l[FOUR], int n,
                            const lanes *restrict x, double *const q[FOUR]) {
    int i = n;
    lanes last = {0.0};
    for (; i >= FOUR; i -= FOUR) {
        lanes pivot[FOUR], above[FOUR], y[FOUR];
        load(p, i - FOUR, pivot);
        load(l, i - FOUR, above);
        for (int j = FOUR - 1; j >= 0; j--) {
            y[j] = last = x[i - FOUR + j] * pivot[j] - above[j] * last;
        }
        store(q, i - FOUR, y);
    }
    while (i-- > 0) {
        lanes pivot, above;
        load_floor(p, i, &pivot);
        load_floor(l, i, &above);
        last = x[i] * pivot - above * last;
        for (int k = 0; k < FOUR; k++) {
            q[k][i] = 0.0 + last[k];
        }
    }
}

LANES void four_solve(const struct effective e[FOUR], double *const r[FOUR],
                      double *const q[FOUR]) {
    const double *const l[FOUR] = {e[0].factor, e[1].factor, e[2].factor, e[3].factor};
    const double *const p[FOUR] = {e[0].pivot, e[1].pivot, e[2].pivot, e[3].pivot};
    const double *const in[FOUR] = {r[0], r[1], r[2], r[3]};
    lanes x[FLOORS_MAX];
    upwards(in, l, e[0].building->n_floor, x);
    downwards(p, l, e[0].building->n_floor, x, q);
}
