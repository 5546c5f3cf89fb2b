// SPDX-License-Identifier: GPL-3.0-or-later
// The tridiagonal case is L D L^T from the ground up (Golub & Van Loan, Matrix Computations,
// section 4.3.6), with the reciprocal pivots stored, so that a solve has no division. The full case
// stores the inverse, which costs n^2 per solve like a pair of triangular solves but has no chain
// of dependences.
#include "solve/effective.h"

#include <gsl/gsl_linalg.h>
#include <string.h>

#include "core/arena.h"

bool effective_alloc(struct effective *e, const struct building *building, struct arena *a) {
    size_t n = (size_t)building->n_floor;
    e->building = building;
    e->tangent = arena_alloc(a, n, sizeof *e->tangent);
    e->pivot = arena_alloc(a, n, sizeof *e->pivot);
    e->factor = arena_alloc(a, n, sizeof *e->factor);
    e->inverse = arena_alloc(a, n * n, sizeof *e->inverse);
    e->ready = arena_alloc(a, n, sizeof *e->ready);
    if (!e->tangent || !e->pivot || !e->factor || !e->inverse || !e->ready) {
        return false;
    }
    memcpy(e->tangent, building->stiffness, n * sizeof *e->tangent);
    return true;
}

// Diagonal entry i of M + b K; the entry to its right is -b tangent[i + 1].
static double diagonal(const struct effective *e, double b, int i) {
    double above = i + 1 < e->building->n_floor ? e->tangent[i + 1] : 0.0;
    return e->building->mass[i] + b * (e->tangent[i] + above);
}

static double right_of(const struct effective *e, double b, int i) {
    return i + 1 < e->building->n_floor ? -b * e->tangent[i + 1] : 0.0;
}

static int factor_tridiagonal(struct effective *e, double b, double g) {
    const struct building *building = e->building;
    double carried = 0.0;
    for (int i = 0; i < building->n_floor; i++) {
        double d = diagonal(e, b, i) + g * building->damping_diagonal[i] - carried;
        double off = right_of(e, b, i) + g * building->damping_off[i];
        if (!(d > 0.0)) {
            return STATUS_RETRY;
        }
        e->pivot[i] = 1.0 / d;
        e->factor[i] = off * e->pivot[i];
        carried = off * e->factor[i];
    }
    memset(e->ready, 0, (size_t)building->n_floor * sizeof *e->ready);
    return STATUS_OK;
}

static int factor_full(struct effective *e, double b, double g) {
    const struct building *building = e->building;
    size_t n = (size_t)building->n_floor;
    for (size_t i = 0; i < n * n; i++) {
        e->inverse[i] = g * building->damping_full[i];
    }
    for (size_t i = 0; i < n; i++) {
        e->inverse[i * n + i] += diagonal(e, b, (int)i);
        if (i + 1 < n) {
            e->inverse[i * n + i + 1] += right_of(e, b, (int)i);
            e->inverse[(i + 1) * n + i] += right_of(e, b, (int)i);
        }
    }
    gsl_matrix_view a = gsl_matrix_view_array(e->inverse, n, n);
    if (gsl_linalg_cholesky_decomp1(&a.matrix) != 0 || gsl_linalg_cholesky_invert(&a.matrix) != 0) {
        return STATUS_RETRY;
    }
    memset(e->ready, true, n * sizeof *e->ready);
    return STATUS_OK;
}

int effective_factor(struct effective *e, double b, double g) {
    return e->building->damping_full ? factor_full(e, b, g) : factor_tridiagonal(e, b, g);
}

static void solve_tridiagonal(const struct effective *e, double *r) {
    int n = e->building->n_floor;
    const double *l = e->factor;
    for (int i = 1; i < n; i++) {
        r[i] -= l[i - 1] * r[i - 1];
    }
    r[n - 1] *= e->pivot[n - 1];
    for (int i = n - 2; i >= 0; i--) {
        r[i] = r[i] * e->pivot[i] - l[i] * r[i + 1];
    }
}

// pivot and factor are free in the full case: `pivot` takes the product.
static void solve_full(const struct effective *e, double *r) {
    int n = e->building->n_floor;
    for (int i = 0; i < n; i++) {
        const double *row = e->inverse + (size_t)i * (size_t)n;
        double sum = 0.0;
        for (int j = 0; j < n; j++) {
            sum += row[j] * r[j];
        }
        e->pivot[i] = sum;
    }
    memcpy(r, e->pivot, (size_t)n * sizeof *r);
}

void effective_solve(const struct effective *e, double *r) {
    if (e->building->damping_full) {
        solve_full(e, r);
    } else {
        solve_tridiagonal(e, r);
    }
}

const double *effective_column(struct effective *e, int i) {
    int n = e->building->n_floor;
    double *column = e->inverse + (size_t)i * (size_t)n;
    if (!e->ready[i]) {
        memset(column, 0, (size_t)n * sizeof *column);
        column[i] = 1.0;
        solve_tridiagonal(e, column);
        e->ready[i] = true;
    }
    return column;
}
