// SPDX-License-Identifier: GPL-3.0-or-later
// What the loops of floor_step.h leave out of buildings with full matrices: C v, and the shears of
// their parts where these are linear. What is read and written beyond a building belongs to the
// next one, and is changed by 0. These functions are not in line, as each step of floor_steps.h
// would have a copy of them. They take no pointers to local variables of a step, which would keep
// these in memory.
#ifndef JOSTLE_FLOORS_FULL_H
#define JOSTLE_FLOORS_FULL_H

#include <stdalign.h>

#include "solve/floors/floor_step.h"
#include "solve/work.h"

// Takes C v, and `with_shears` those of parts, off the residual of the buildings of a block.
FLOORS_CLONES static void floors_full_forces(const struct work *w, const struct floor_block *b,
                                             bool with_shears) {
    alignas(LANES_LINE) double drift[FLOORS_MAX], force[FLOORS_MAX], shear[FLOORS_MAX];
    for (int k = b->building; k < b->building + b->n_building; k++) {
        const struct effective *e = &w->effective[k];
        const int n = e->building->n_dof;
        const ptrdiff_t at = e->building->first - b->first;
        const bool with_parts = e->parts && with_shears;
        double *residual = w->floors.residual + at;
        floor_lanes under = none, over;
        if (!e->damping) {
            continue;
        }
        for (int i = 0; with_parts && i < e->stride; i += FLOORS_VECTOR) {
            const floor_lanes own = FLOORS_AT(w->floors.u_trial + at, i);
            FLOORS_SET(drift, i) = own - BELOW(under, own);
            under = own;
        }
        floors_multiply(e->damping, n, false, w->floors.v_trial + at, force);
        if (with_parts) {
            floors_multiply(e->parts, n, false, drift, shear);
        }
        for (int i = 0; i < e->stride; i += FLOORS_VECTOR) {
            floor_lanes left = FLOORS_AT(residual, i) - FLOORS_AT(force, i);
            if (with_parts) {
                over = i + FLOORS_VECTOR < e->stride ? FLOORS_AT(shear, i + FLOORS_VECTOR) : none;
                left += ABOVE(FLOORS_AT(shear, i), over) - FLOORS_AT(shear, i);
            }
            FLOORS_SET(residual, i) = left;
        }
    }
}

// Adds the shears of parts at the drifts of `s` to those of the storeys alone.
FLOORS_CLONES static void floors_full_strain(const struct work *w, struct state *s) {
    for (int k = 0; w->model->chain.parts && k < w->model->n_body; k++) {
        const struct effective *e = &w->effective[k];
        if (e->parts) {
            const double *drift = s->drift + e->building->first;
            floors_multiply(e->parts, e->building->n_dof, true, drift,
                            s->shear + e->building->first);
        }
    }
}

// Adds twice the work of C in the step from s0 to s1.
FLOORS_CLONES static void floors_full_work(const struct work *w, const struct state *s0,
                                           const struct state *s1) {
    double *damping_2x = w->floors.account.energy->damping_2x;
    alignas(LANES_LINE) double mean_2x[FLOORS_MAX], force_2x[FLOORS_MAX];
    for (int k = 0; k < w->model->n_body; k++) {
        const struct effective *e = &w->effective[k];
        const int first = e->building->first;
        if (!e->damping) {
            continue;
        }
        for (int i = 0; i < e->stride; i += FLOORS_VECTOR) {
            FLOORS_SET(mean_2x, i) = FLOORS_AT(s0->v + first, i) + FLOORS_AT(s1->v + first, i);
        }
        floors_multiply(e->damping, e->building->n_dof, false, mean_2x, force_2x);
        for (int i = 0; i < e->stride; i += LANES_WIDTH) {
            EACH_OF_LANES(j) {
                const ptrdiff_t at = i + j * FLOORS_VECTOR;
                FLOORS_SET(damping_2x, j * FLOORS_VECTOR) +=
                    FLOORS_AT(force_2x, at) *
                    (FLOORS_AT(s1->u + first, at) - FLOORS_AT(s0->u + first, at));
            }
        }
    }
}

#endif
