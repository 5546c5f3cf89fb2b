// SPDX-License-Identifier: GPL-3.0-or-later
// The largest and smallest of the forces that follow from drifts and departures of hinges
// (model/forces.h), over all computed steps.
//
// Such actions of FORCES_BATCH states are collected. An action stays near the straight line from
// the first to the last of them: by its bow at most. So a force with the row p stays between its
// values at the first and the last state, widened by sum(|p| bow). Only forces that may so exceed
// their extremes so far are computed, state by state. They are few.
#ifndef JOSTLE_FORCE_PEAKS_H
#define JOSTLE_FORCE_PEAKS_H

#include "solve/account/yielding.h"
#include "solve/state.h"

struct force_peaks {
    const struct model *model;
    struct results *results;   // borrowed
    struct yielding yielding;  // which is noted at the same states
    int n;                     // states in the batch
    double time[FORCES_BATCH];
    int n_action;    // of a state: model.chain.n drifts, then departures
    double *action;  // (FORCES_BATCH, n_action)
    double *bow;     // (n_action) scratch
    double *turned;  // (n_action, FORCES_BATCH) scratch: those of a building, one by one
};
extern const struct fields force_peaks_fields;

// Room for the forces of the results' model; false: no memory.
bool force_peaks_alloc(struct force_peaks *p, const struct model *m, struct results *r,
                       struct arena *a);

// Are there forces or laws that must be noted?
static inline bool force_peaks_due(const struct force_peaks *p) {
    return p->model->n_force > 0 || p->yielding.n > 0;
}

// Takes the states of the batch into the extremes, and empties it.
void force_peaks_flush(struct force_peaks *p);

// Takes a state: its displacements, and departures of hinges.
static inline void force_peaks_note(struct force_peaks *p, const struct state *s) {
    const struct model *m = p->model;
    const struct chain *c = &m->chain;
    if (p->yielding.n > 0) {
        yielding_note(&p->yielding, s);
    }
    if (m->n_force == 0) {
        return;
    }
    double *action = p->action + (ptrdiff_t)p->n * p->n_action;
    for (int i = 0; i < c->n; i++) {
        action[i] = s->u[i] - c->joint[i] * s->u[i - 1];
    }
    state_struck(s, m, action);
    for (int k = 0; m->n_hinge > 0 && k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        memcpy(action + c->n + g->first_hinge, s->storey_history + g->departure,
               (size_t)g->n_hinge * sizeof *action);
    }
    p->time[p->n++] = s->time;
    if (p->n == FORCES_BATCH) {
        force_peaks_flush(p);
    }
}

#endif
