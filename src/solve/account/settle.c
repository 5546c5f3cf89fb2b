// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method on the drifts of a building at which its shears are 0, from its histories at the
// end of the analysis and without velocities.
#include "solve/account/settle.h"

#include <assert.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/parts.h"

enum { SETTLE_MAX = 100 };

// A step of Newton's method is halved down to this share; shears that are left at rest, of those at
// the end of the analysis.
static const double HALVED_MIN = 1e-9, SETTLED = 1e-9;

// Shears of a building with parts at its drifts `x`, at rest, and their tangent.
struct rest {
    const struct model *model;
    const struct building *building;
    const double *history;
    gsl_matrix *tangent;  // (n, n)
    gsl_vector *shear;    // (n)
    gsl_vector *change;   // (n) of x
    gsl_permutation *order;
    double *x, *trial, *still;  // (n) still: drift rates of 0
};

static double settle_find_shears(struct rest *r, const double *x) {
    const struct building *b = r->building;
    double *shear = r->shear->data, *tangent = r->tangent->data;
    gsl_vector_set_zero(r->shear);
    gsl_matrix_set_zero(r->tangent);
    const struct part_sums sums = {.shear = shear, .by_drift = tangent};
    parts_respond(b, r->history, x, r->still, &sums, NULL);
    for (int i = 0; i < b->n_floor; i++) {
        const struct storey *storey = &r->model->storey[b->first + i];
        const struct storey_response own =
            storey->law->respond(storey->constant, r->history + storey->history, x[i], NULL);
        shear[i] += own.shear;
        tangent[i * b->n_floor + i] += own.tangent;
    }
    return gsl_blas_dnrm2(r->shear);
}

// One step of Newton's method, halved until the shears become smaller. False: none does so.
static bool settle_improve(struct rest *r, double *size) {
    const int n = r->building->n_floor;
    int sign;
    if (gsl_linalg_LU_decomp(r->tangent, r->order, &sign) != 0 ||
        gsl_linalg_LU_solve(r->tangent, r->order, r->shear, r->change) != 0) {
        return false;
    }
    double before = *size;
    for (double share = 1.0; share > HALVED_MIN; share /= 2.0) {
        for (int i = 0; i < n; i++) {
            r->trial[i] = r->x[i] - share * gsl_vector_get(r->change, (size_t)i);
        }
        *size = settle_find_shears(r, r->trial);
        if (*size < before) {
            memcpy(r->x, r->trial, (size_t)n * sizeof *r->x);
            return true;
        }
    }
    return false;
}

// Brings r->x from the drifts of the state to those without shears, or as near as rounding allows.
// NAN where a law does not let them come there.
static void settle_building(struct rest *r, const struct state *s, double *out) {
    const int n = r->building->n_floor;
    memcpy(r->x, s->drift + r->building->first, (size_t)n * sizeof *r->x);
    const double start = settle_find_shears(r, r->x);
    double size = start;
    for (int i = 0; i < SETTLE_MAX && size > 0.0 && settle_improve(r, &size); i++) {
    }
    for (int i = 0; i < n; i++) {
        out[i] = size <= SETTLED * start ? fabs(r->x[i]) : (double)NAN;
    }
}

static bool settle_is_allocated(const struct rest *r) {
    return r->tangent && r->shear && r->change && r->order && r->x;
}

void settle_drifts(const struct model *m, const struct state *s, const struct building *b,
                   double *out) {
    const size_t n = (size_t)b->n_floor;
    assert(b->n_part > 0 && b->first + b->n_floor <= m->n_dof);
    double *x = calloc(3 * n, sizeof *x);
    struct rest r = {
        .model = m,
        .building = b,
        .history = s->storey_history,
        .tangent = gsl_matrix_alloc(n, n),
        .shear = gsl_vector_alloc(n),
        .change = gsl_vector_alloc(n),
        .order = gsl_permutation_alloc(n),
        .x = x,
    };
    if (settle_is_allocated(&r)) {
        r.trial = x + n;
        r.still = x + 2 * n;
        settle_building(&r, s, out);
    }
    for (size_t i = 0; !settle_is_allocated(&r) && i < n; i++) {
        out[i] = (double)NAN;
    }
    gsl_matrix_free(r.tangent);
    gsl_vector_free(r.shear);
    gsl_vector_free(r.change);
    gsl_permutation_free(r.order);
    free(x);
}
