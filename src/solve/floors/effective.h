// SPDX-License-Identifier: GPL-3.0-or-later
// The effective mass matrix of one building under Newmark, factorised:
//     A = M + gamma h C + beta h^2 K,   A a = r.
// It is tridiagonal for a shear building, and full with modal damping or with parts. Buildings
// never share a matrix: contact forces couple them through columns of A^-1.
#ifndef JOSTLE_EFFECTIVE_H
#define JOSTLE_EFFECTIVE_H

#include "core/lanes.h"
#include "jostle/model.h"
#include "solve/fields.h"

// How long a factorisation will serve.
enum effective_use {
    EFFECTIVE_BRIEFLY,  // a step or so: solves go through the factors
    EFFECTIVE_LONG,  // solves of low buildings multiply by the inverse, unless many have one height
};

// Low buildings have up to INVERSE_FLOORS_MAX floors. EFFECTIVE_ABREAST is the distance of the
// factors of one floor from those of the next.
enum { INVERSE_FLOORS_MAX = 16, EFFECTIVE_ABREAST = LANES_WIDTH };

struct effective {
    const struct building *building;  // borrowed
    enum effective_use use;
    double b, g;             // beta h^2 and gamma h of the factors; NAN: none
    double *tangent;         // [F/L] tangents it was factorised with: of the storeys (n_floor), and
                             // with parts theirs by drifts and by rates, each (n_floor, n_floor)
    double *pivot, *factor;  // (n_floor) 1/d_i and l_i of A = L D L^T; tridiagonal. Those of
                             // neighbours of one height lie side by side, in whole lanes
    int abreast;             // how many from this one on are solved together; 0: none
    double *between;         // (n_floor) vectors: scratch of such a group; NULL: solved alone
    int stride;              // of the rows of `inverse`: n_floor in whole lanes
    double *inverse;         // (stride, stride) A^-1, rows ready where marked, and zeros
    double *damping, *parts;  // (stride, stride) likewise C, and the initial stiffness of parts by
                              // drifts; NULL: it has no such full matrix
    bool *ready;              // (n_floor) row of `inverse` is valid
    int n_ready;              // rows below this are
    struct reach {
        int from, to;  // in whole lanes
    } * reach;         // (n_floor) of ready rows: entries outside are below rounding
};
extern const struct fields effective_fields;  // from which factors and rows can be made again

// Room for the factors of n buildings of a row, with the initial tangents; false: no memory.
bool effective_alloc(struct effective *e, const struct building *building, int n,
                     enum effective_use use, struct arena *a);

// How many of n buildings, from the first on, have one height, so that they may be solved together.
int effective_alike(const struct building *building, int n);

// Factorises A for beta h^2 = `b`, gamma h = `g` and the tangents of `e`. STATUS_RETRY: A is not
// positive definite to working accuracy.
int effective_factor(struct effective *e, double b, double g);

// Makes factors and rows again, after the fields have been replaced.
void effective_resume(struct effective *e);

// Whether solves multiply by the inverse, once it is there.
static inline bool effective_prefers_inverse(const struct effective *e) {
    return e->use == EFFECTIVE_LONG &&
           (e->building->damping_full || (e->building->n_dof <= INVERSE_FLOORS_MAX && !e->between));
}

static inline bool effective_has_inverse(const struct effective *e) {
    return e->n_ready == e->building->n_dof && effective_prefers_inverse(e);
}

// q = A^-1 r for n buildings, whose floors follow each other in r and q, arrays of core/lanes.h.
// What follows them in r must be finite, and may be written to in q; r is overwritten. Much faster
// than one by one where they are low, or where several have the same height.
void effective_solve(struct effective *e, int n, double *r, double *q);

// Column (and row) `i` of A^-1, (n_floor): the accelerations of all floors under a unit force on
// floor i + 1. Computed when first asked for after a factorisation.
const double *effective_column(struct effective *e, int i);

#endif
