// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/definite.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

// Entries this small against the largest of the diagonal are rounding.
static const double ROUNDING = 1e-10;

enum { SWEEPS_MAX = 30 };  // each of Jacobi's squares the error at last

// Has the matrix no negative eigenvalue? By L D L' in `f` (n, n).
static bool definite_is(const double *k, int n, double *f) {
    double most = 0.0;
    memcpy(f, k, (size_t)n * (size_t)n * sizeof *f);
    for (int i = 0; i < n; i++) {
        most = fmax(most, fabs(k[i * n + i]));
    }
    for (int j = 0; j < n; j++) {
        const double pivot = f[j * n + j];
        const bool nothing = fabs(pivot) <= ROUNDING * most;
        if (pivot < -ROUNDING * most) {
            return false;
        }
        for (int i = j + 1; i < n; i++) {
            const double entry = f[j * n + i];
            if (nothing && fabs(entry) > ROUNDING * most) {
                return false;
            }
            for (int l = i; !nothing && l < n; l++) {
                f[i * n + l] -= entry / pivot * f[j * n + l];
            }
        }
    }
    return true;
}

// Turns axes p and q of the matrix a, and those of the vectors v, so that a_pq becomes 0.
static void definite_turn(double *a, double *v, int n, int p, int q) {
    const double half = (a[q * n + q] - a[p * n + p]) / (2.0 * a[p * n + q]);
    const double t = copysign(1.0, half) / (fabs(half) + hypot(half, 1.0));
    const double c = 1.0 / hypot(t, 1.0), s = t * c;
    for (int i = 0; i < n; i++) {
        const double at_p = a[i * n + p], at_q = a[i * n + q];
        a[i * n + p] = c * at_p - s * at_q;
        a[i * n + q] = s * at_p + c * at_q;
    }
    for (int i = 0; i < n; i++) {
        const double at_p = a[p * n + i], at_q = a[q * n + i];
        const double v_p = v[p * n + i], v_q = v[q * n + i];
        a[p * n + i] = c * at_p - s * at_q;
        a[q * n + i] = s * at_p + c * at_q;
        v[p * n + i] = c * v_p - s * v_q;
        v[q * n + i] = s * v_p + c * v_q;
    }
}

void definite_clip(double *k, int n, double *scratch) {
    double *a = scratch, *v = scratch + (size_t)n * (size_t)n;
    if (definite_is(k, n, a)) {
        return;
    }
    memcpy(a, k, (size_t)n * (size_t)n * sizeof *a);
    memset(v, 0, (size_t)n * (size_t)n * sizeof *v);
    for (int i = 0; i < n; i++) {
        v[i * n + i] = 1.0;
    }
    bool turned = true;
    for (int sweep = 0; turned && sweep < SWEEPS_MAX; sweep++) {
        turned = false;
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) {
                if (fabs(a[p * n + q]) > 1e-16 * (fabs(a[p * n + p]) + fabs(a[q * n + q]))) {
                    definite_turn(a, v, n, p, q);
                    turned = true;
                }
            }
        }
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j <= i; j++) {
            double sum = k[i * n + j];
            for (int m = 0; m < n; m++) {
                sum -= fmin(a[m * n + m], 0.0) * (v[m * n + i] * v[m * n + j]);
            }
            k[i * n + j] = k[j * n + i] = sum;
        }
    }
}
