// SPDX-License-Identifier: GPL-3.0-or-later
// The system of equations of motion for the method of Dormand & Prince, with every law held on the
// branch that it is on at the start of the step.
#ifndef JOSTLE_DP_SYSTEM_H
#define JOSTLE_DP_SYSTEM_H

#include <assert.h>
#include <float.h>

#include "solve/forcing.h"
#include "solve/state.h"

// The branch of a link in a step: its velocity has this sign. That is what the law of a contact
// sees; that of a bilateral link sees the velocity itself.
enum phase {
    PHASE_RELEASE = -1,
    PHASE_ANY = 0,  // bilateral links whose force is smooth at v = 0
    PHASE_APPROACH = 1,
};

// What a floor's acceleration is made of, besides loads and links, each an array of core/lanes.h:
// M^-1 K and M^-1 C, each with the floor below, the floor itself and the one above; M^-1 times the
// forces that do not depend on the motion; and the share of the ground's acceleration, 1. For their
// works: the mass that the ground carries, and C, with twice what joins a floor to the one above.
enum dp_row {
    DP_K_BELOW,
    DP_K_OWN,
    DP_K_ABOVE,
    DP_C_BELOW,
    DP_C_OWN,
    DP_C_ABOVE,
    DP_CONSTANT,
    DP_GROUND,
    DP_CARRIED,
    DP_DAMPER,
    DP_DAMPER_ABOVE,
    DP_ROWS
};

struct dp_floors;

struct dp_system {
    const struct model *model;       // borrowed
    const struct dp_floors *floors;  // what is done with all of them, in vectors
    struct forcing forcing;
    bool special;            // is there more than linear floors on one ground, and links?
    double *row[DP_ROWS];    // (n_dof) coefficients of the accelerations on this branch
    double *mobility;        // [1/M] (n_dof) 1 / m
    double *base, *tangent;  // [F] [F/L] (n_dof) shear = base + tangent drift on this branch
    double *most_drift;      // [L] (n_dof) largest committed drift of the inelastic storeys
    double *damping;         // [F] (n_dof) scratch
    double *part_drift, *part_rate, *part_shear;  // (n_dof) scratch of dp_parts.c
    double *part_history;                         // (model.n_storey_history) its scratch, too
    enum phase *phase;                            // (n_link)
    int n_inelastic;                              // storeys with a history
    int *inelastic;                               // (n_dof) their indices
    int *below;     // (n_dof) index of the floor below; -1: the ground
    int *building;  // (n_dof) index of the floor's building
    bool *calls;    // (n_dof) the storey's law is called, as it is not made of lines
};

// What changes in it.
extern const struct fields dp_system_fields;

// Room for a system; false: no memory.
bool dp_system_alloc(struct dp_system *s, const struct model *m, struct arena *a);

// The branches at state `now`: forcing, storeys and links.
void dp_system_start(struct dp_system *s, const struct state *now);

// The branch of the inelastic storey below floor i at its committed state when its drift goes on in
// `direction` (its sign) beyond `from`: its drift, or the end of its line, from which it may be
// farther than is noise.
void dp_system_branch(struct dp_system *s, const struct state *now, int i, double from,
                      double direction);

// Tangent of the storey at `drift` with the committed history, and the smallest change of its drift
// that counts.
double dp_system_tangent(const struct dp_system *s, const struct state *now, int i, double drift);
double dp_system_storey_noise(const struct dp_system *s, const struct state *now, int i);

// Shear of the storey below floor i at `drift`, on its branch [F].
double dp_system_shear(const struct dp_system *s, const struct state *now, int i, double drift);

// state_gap of an array of core/lanes.h: a wall stands at the zero in front of it.
static inline double dp_system_across(const struct link *l, const struct model *m, const double *x,
                                      const double *ground) {
    static_assert(WALL == -1, "a wall is the zero in front of an array");
    const double own = link_is_plain(l) ? x[l->dof[0]] - x[l->dof[1]] : link_across(l, x);
    return own + state_ground_gap(l, m, ground);
}

// The response of link k at (d, v) on its branch; d and v may lie beyond it.
static inline struct contact_response
dp_system_response(const struct dp_system *s, const struct state *now, int k, double d, double v) {
    const struct link *l = &s->model->link[k];
    const double *history = now->link_history + l->history;
    if (l->bilateral) {
        return l->law->force(l->constant, history, d, v);
    }
    int phase = s->phase[k];
    double inside = d > 0.0 ? d : 0.0;
    double seen = phase * v > 0.0 ? v : phase * DBL_MIN;
    struct contact_response r = l->law->force(l->constant, history, inside, seen);
    if (seen != v) {
        r.force += r.dfdv * v;
    }
    if (inside != d) {
        r.force += r.dfdd * d;
    }
    return r;
}

// How far its branch has led from its law at `now`, as a drift [L]: the sum of events that were too
// small to count.
double dp_system_storey_lag(const struct dp_system *s, const struct state *now, int i);

// Brings the histories of `now` to its present drifts, penetrations and velocities.
void dp_system_commit(const struct dp_system *s, struct state *now);

#endif
