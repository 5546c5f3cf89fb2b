// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian elimination with partial pivoting (Golub & Van Loan, Matrix Computations, section
// 4.3.3): exchanges of rows let the band above the diagonal become twice as wide. GSL has the same
// from 2.7 on only; older ones are in use.
#include "solve/contact/band.h"

#include <math.h>

#include "core/lanes.h"

// The row from k to `last` with the largest entry in column k.
static int pivot_row(const double *a, int n, int k, int last) {
    int row = k;
    for (int i = k + 1; i <= last; i++) {
        if (fabs(a[i * n + k]) > fabs(a[row * n + k])) {
            row = i;
        }
    }
    return row;
}

static void exchange(double *x, double *y, int n) {
    for (int i = 0; i < n; i++) {
        const double kept = x[i];
        x[i] = y[i];
        y[i] = kept;
    }
}

// Subtracts from the rows below row k, up to `last`, what makes their column k 0; row k has `m`
// entries from there on.
LANES static void eliminate(double *a, double *b, int n, int k, int last, int m) {
    const double *restrict pivot = a + k * n + k;
    for (int i = k + 1; i <= last; i++) {
        double *restrict row = a + i * n + k;
        const double share = row[0] / pivot[0];
        LANES_LOOP
        for (int j = 1; j < m; j++) {
            row[j] -= share * pivot[j];
        }
        b[i] -= share * b[k];
    }
}

bool band_solve(double *a, double *b, int n, int width) {
    for (int k = 0; k < n; k++) {
        const int last = k + width < n ? k + width : n - 1;
        const int m = k + 2 * width < n ? 2 * width + 1 : n - k;
        const int row = pivot_row(a, n, k, last);
        if (row != k) {
            exchange(a + k * n + k, a + row * n + k, m);
            exchange(b + k, b + row, 1);
        }
        if (a[k * n + k] == 0.0) {
            return false;
        }
        eliminate(a, b, n, k, last, m);
    }
    bool finite = true;
    for (int k = n - 1; k >= 0; k--) {
        const int m = k + 2 * width < n ? 2 * width + 1 : n - k;
        for (int j = 1; j < m; j++) {
            b[k] -= a[k * n + k + j] * b[k + j];
        }
        b[k] /= a[k * n + k];
        finite = finite && isfinite(b[k]);
    }
    return finite;
}
