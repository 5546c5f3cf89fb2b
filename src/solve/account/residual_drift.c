// SPDX-License-Identifier: GPL-3.0-or-later
// A storey that stands still without loads has no shear. Laws know the shear at any drift that is
// reached straight from their history, so that this drift is a root of the shear, on the side to
// which it pulls.
//
// So it is with a link that has a storey law. The damper of Maxwell's law stays where it is.
//
// The storeys of a building with parts come to rest together: Newton's method finds the drifts at
// which all shears are 0, from the histories at the end of the analysis and without velocities.
#include <assert.h>
#include <float.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/root.h"
#include "law/link_law.h"
#include "model/foundation.h"
#include "model/parts.h"
#include "model/storey_force.h"
#include "solve/account/account.h"

enum { DOUBLINGS = 60, ITERATIONS_MAX = 100 };

// A step of Newton's method is halved down to this share; shears that are left at rest, of those at
// the end of the analysis.
static const double HALVED_MIN = 1e-9, SETTLED = 1e-9;

struct unloading {
    const struct storey *storey;
    const double *history;
};

static double residual_drift_shear(double drift, void *context) {
    const struct unloading *u = context;
    return storey_respond(u->storey, u->history, drift, NULL).shear;
}

// The way back is that at the initial stiffness, or longer where the law softens or yields back.
static double residual_drift_unload(struct unloading u, double stiffness, double drift) {
    const double shear = residual_drift_shear(drift, &u);
    double way = -shear / stiffness;
    for (int i = 0; i < DOUBLINGS && residual_drift_shear(drift + way, &u) * shear > 0.0; i++) {
        way *= 2.0;
    }
    const double low = fmin(drift, drift + way), high = fmax(drift, drift + way);
    return shear == 0.0 ? drift : root_find(residual_drift_shear, &u, low, high, DBL_EPSILON);
}

void residual_links(const struct model *m, const struct state *s, struct link_peak *link) {
    for (int k = m->n_contact; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        const double *history = s->link_history + l->history;
        const double stored =
            l->law->stored ? l->law->stored(l->constant, history, s->delta[k]) : 0.0;
        link[k].lost = link[k].dissipated - stored;
        if (l->law->creep) {
            link[k].residual = fabs(history[1]);
        } else if (l->law->traits & CONTACT_TURNS) {
            const struct link_storey of = link_law_storey(l->constant, history);
            const struct storey storey = {.law = of.law, .constant = of.constant};
            const struct unloading u = {&storey, of.history};
            link[k].residual =
                fabs(residual_drift_unload(u, l->constant[LINK_STIFFNESS], of.deformation));
        }
    }
}

// A building with parts, its shears and their tangent at rest.
struct settling {
    const struct model *model;
    const struct building *building;
    const double *history;
    size_t n;                   // floors
    double *tangent;            // (n, n)
    double *shear, *change;     // (n) change: of x
    double *x, *trial, *still;  // (n) drifts; still: drift rates of 0
    double *scratch;            // (model.n_part_scratch) of parts
    size_t *order;              // (n) of the rows in the factorisation
};

// Finds the shears at drifts x, and their tangent. Returns their size.
static double residual_drift_shears(struct settling *r, const double *x) {
    const struct building *b = r->building;
    memset(r->shear, 0, r->n * sizeof *r->shear);
    memset(r->tangent, 0, r->n * r->n * sizeof *r->tangent);
    const struct part_sums sums = {
        .shear = r->shear, .by_drift = r->tangent, .scratch = r->scratch};
    parts_respond(b, r->history, x, r->still, &sums, NULL);
    for (size_t i = 0; i < r->n; i++) {
        const struct storey *storey = &r->model->storey[(size_t)b->first + i];
        const struct storey_response own = storey_respond(storey, r->history, x[i], NULL);
        r->shear[i] += own.shear;
        r->tangent[i * r->n + i] += own.tangent;
    }
    const gsl_vector_view shear = gsl_vector_view_array(r->shear, r->n);
    return gsl_blas_dnrm2(&shear.vector);
}

// One step of Newton's method, halved until the shears become smaller. False: none does so.
static bool residual_drift_improve(struct settling *r, double *size) {
    gsl_matrix_view tangent = gsl_matrix_view_array(r->tangent, r->n, r->n);
    const gsl_vector_view shear = gsl_vector_view_array(r->shear, r->n);
    gsl_vector_view change = gsl_vector_view_array(r->change, r->n);
    gsl_permutation order = {r->n, r->order};
    int sign;
    if (gsl_linalg_LU_decomp(&tangent.matrix, &order, &sign) != 0 ||
        gsl_linalg_LU_solve(&tangent.matrix, &order, &shear.vector, &change.vector) != 0) {
        return false;
    }
    double before = *size;
    for (double share = 1.0; share > HALVED_MIN; share /= 2.0) {
        for (size_t i = 0; i < r->n; i++) {
            r->trial[i] = r->x[i] - share * r->change[i];
        }
        *size = residual_drift_shears(r, r->trial);
        if (*size < before) {
            memcpy(r->x, r->trial, r->n * sizeof *r->x);
            return true;
        }
    }
    return false;
}

// The residual drifts of building `b` with parts, or as near to them as rounding allows. NAN: a law
// does not let them come there.
static void residual_drift_settle(const struct model *m, const struct state *s,
                                  const struct building *b, double *out, struct arena *a) {
    const size_t n = (size_t)b->n_dof;
    struct settling r = {m, b, s->storey_history, .n = n};
    double **const array[] = {&r.tangent, &r.shear, &r.change, &r.x, &r.trial, &r.still};
    assert(b->n_part > 0 && b->first + b->n_dof <= m->n_dof);
    for (size_t i = 0; i < sizeof array / sizeof array[0]; i++) {
        *array[i] = arena_alloc(a, i == 0 ? n * n : n, sizeof(double));
    }
    r.order = arena_alloc(a, n, sizeof *r.order);
    r.scratch = arena_alloc(a, (size_t)m->n_part_scratch, sizeof *r.scratch);
    for (size_t i = 0; i < n; i++) {
        out[i] = (double)NAN;
    }
    if (!arena_failed(a)) {
        memcpy(r.x, s->drift + b->first, n * sizeof *r.x);
        const double start = residual_drift_shears(&r, r.x);
        double size = start;
        for (int i = 0; i < ITERATIONS_MAX && size > 0.0 && residual_drift_improve(&r, &size);
             i++) {
        }
        for (size_t i = 0; size <= SETTLED * start && i < n; i++) {
            out[i] = fabs(r.x[i]);
        }
    }
}

// The residual drifts of building `b` whose storeys come to rest one by one, from their drifts. One
// with a foundation comes to rest on a foundation that has not moved.
static void residual_drift_storeys(const struct model *m, const struct state *s,
                                   const struct building *b, const double *drift, double *out) {
    const struct building *own = b->fixed ? b->fixed : b;
    const double *history = s->storey_history + (b->fixed ? b->part->history : 0);
    for (int i = 0; i < b->n_floor; i++) {
        const struct storey *storey = foundation_storey(m, b, i);
        const struct unloading u = {storey, history};
        out[i] = storey->law->n_history == 0
                     ? 0.0
                     : fabs(residual_drift_unload(u, own->stiffness[i], drift[i]));
    }
}

bool residual_drifts(const struct model *m, const struct state *s, double *out, struct arena *a) {
    double drift[FLOORS_MAX], shear[FLOORS_MAX];
    for (const struct building *b = m->building; b < m->building + m->n_body; b++) {
        const struct building *own = b->fixed ? b->fixed : b;
        if (own->n_part > 0 && !b->elastic) {
            residual_drift_settle(m, s, b, out + b->first, a);
            continue;
        }
        if (b->fixed) {
            foundation_storeys(b, s->storey_history, s->drift + b->first, s->shear + b->first,
                               drift, shear);
        }
        residual_drift_storeys(m, s, b, b->fixed ? drift : s->drift + b->first, out + b->first);
    }
    return !arena_failed(a);
}
