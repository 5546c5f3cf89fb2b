// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian elimination with partial pivoting (Golub & Van Loan, Matrix Computations, section
// 4.3.3): exchanges of rows let the band above the diagonal become twice as wide. GSL has the same
// from 2.7 on only; older ones are in use.
#include "solve/contact/band.h"

#include <math.h>

#include "core/lanes.h"

// The row from k to `last` with the largest entry in column k.
static ptrdiff_t band_pivot(const double *a, ptrdiff_t n, ptrdiff_t k, ptrdiff_t last) {
    ptrdiff_t row = k;
    for (ptrdiff_t i = k + 1; i <= last; i++) {
        if (fabs(a[i * n + k]) > fabs(a[row * n + k])) {
            row = i;
        }
    }
    return row;
}

static void band_exchange(double *x, double *y, ptrdiff_t n) {
    for (ptrdiff_t i = 0; i < n; i++) {
        const double kept = x[i];
        x[i] = y[i];
        y[i] = kept;
    }
}

// Subtracts from the rows below row k, up to `last`, what makes their column k 0; row k has `m`
// entries from there on.
LANES static void band_eliminate(double *a, double *b, ptrdiff_t n, ptrdiff_t k, ptrdiff_t last,
                                 ptrdiff_t m) {
    const double *restrict pivot = a + k * n + k;
    for (ptrdiff_t i = k + 1; i <= last; i++) {
        double *restrict row = a + i * n + k;
        const double share = row[0] / pivot[0];
        LANES_LOOP
        for (ptrdiff_t j = 1; j < m; j++) {
            row[j] -= share * pivot[j];
        }
        b[i] -= share * b[k];
    }
}

bool band_solve(double *a, double *b, ptrdiff_t n, ptrdiff_t width) {
    for (ptrdiff_t k = 0; k < n; k++) {
        const ptrdiff_t last = k + width < n ? k + width : n - 1;
        const ptrdiff_t m = k + 2 * width < n ? 2 * width + 1 : n - k;
        const ptrdiff_t row = band_pivot(a, n, k, last);
        if (row != k) {
            band_exchange(a + k * n + k, a + row * n + k, m);
            band_exchange(b + k, b + row, 1);
        }
        if (a[k * n + k] == 0.0) {
            return false;
        }
        band_eliminate(a, b, n, k, last, m);
    }
    bool finite = true;
    for (ptrdiff_t k = n - 1; k >= 0; k--) {
        const ptrdiff_t m = k + 2 * width < n ? 2 * width + 1 : n - k;
        for (ptrdiff_t j = 1; j < m; j++) {
            b[k] -= a[k * n + k + j] * b[k + j];
        }
        b[k] /= a[k * n + k];
        finite = finite && isfinite(b[k]);
    }
    return finite;
}
