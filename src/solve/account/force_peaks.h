// SPDX-License-Identifier: GPL-3.0-or-later
// The largest and smallest of the forces that follow from drifts (model/forces.h), over all
// computed steps.
//
// Drifts of FORCES_BATCH states are collected. A drift stays near the straight line from the first
// to the last of them: by its bow at most. So a force with the row p stays between its values at
// the first and the last state, widened by sum(|p| bow). Only forces that may so exceed their
// extremes so far are computed, state by state. They are few.
#ifndef JOSTLE_FORCE_PEAKS_H
#define JOSTLE_FORCE_PEAKS_H

#include "solve/state.h"

struct force_peaks {
    const struct model *model;
    struct results *results;  // borrowed
    int n;                    // states in the batch
    double time[FORCES_BATCH];
    double *drift;  // [L] (FORCES_BATCH, model.chain.n)
    double *bow;    // [L] (n_dof) scratch
    double
        *turned;  // [L] (n_dof, FORCES_BATCH) scratch: the drifts of a building, storey by storey
};
extern const struct fields force_peaks_fields;

// Room for the forces of the results' model; false: no memory.
bool force_peaks_alloc(struct force_peaks *p, const struct model *m, struct results *r,
                       struct arena *a);

// Takes the states of the batch into the extremes, and empties it.
void force_peaks_flush(struct force_peaks *p);

// Takes a value of force i of all.
static inline void force_peaks_take(struct results *r, int i, double value, double time) {
    if (value > r->force_max[i]) {
        r->force_max[i] = value;
        r->force_max_time[i] = time;
    }
    if (value < r->force_min[i]) {
        r->force_min[i] = value;
        r->force_min_time[i] = time;
    }
}

// Takes a state with displacements u, an array of core/lanes.h.
static inline void force_peaks_note(struct force_peaks *p, const double *u, double time) {
    const struct chain *c = &p->model->chain;
    double *drift = p->drift + (ptrdiff_t)p->n * c->n;
    for (int i = 0; i < c->n; i++) {
        drift[i] = u[i] - c->joint[i] * u[i - 1];
    }
    p->time[p->n++] = time;
    if (p->n == FORCES_BATCH) {
        force_peaks_flush(p);
    }
}

#endif
