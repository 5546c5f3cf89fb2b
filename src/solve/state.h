// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that changes while an analysis runs, and nothing else. A step reads the committed
// state and writes the next one; committing swaps the two, so a failed step leaves no trace.
#ifndef JOSTLE_STATE_H
#define JOSTLE_STATE_H

#include <stdalign.h>

#include "core/lanes.h"
#include "jostle/analysis.h"
#include "model/link_end.h"
#include "solve/fields.h"

// Steps before the last one whose forces a guess is drawn from.
enum { PAST_STEPS = 3 };

// One link.
struct link_state {
    alignas(LANES_LINE) double force;  // [F]
    double past[PAST_STEPS];           // [F] of a live link one step before, two and three
    double t_close;                    // [T] instant of closure of a closed link
    double v_close;                    // [L/T] closing velocity then
    int n_past;                        // in how many past steps it was closed
    bool is_live;                      // it is in `live`
    bool closed;                       // in contact; bilateral links always are
};

struct state {
    double time;  // [T]

    // Degrees of freedom, all (n_dof) and arrays of core/lanes.h
    double *u, *v, *a;       // [L] [L/T] [L/T^2] relative to the ground
    double *base, *total;    // [L/T^2] acceleration of the ground, and a + base
    double *drift, *shear;   // [L] [F] of the storey below
    double *tangent;         // [F/L] of the storey below, at the drift; of elastic buildings unset
    double *rate;            // [L/T] of the drifts of buildings with parts
    double *external;        // [F] loads and -m a_ground
    double *storey_history;  // (model.n_storey_history)
    double *scratch;         // (model.n_part_scratch) of parts, which carries nothing

    // Links. Those not in `live` are open, with force 0.
    int n_live, *live;        // links that were closed in the step to this state, or are; ascending
    struct link_state *link;  // (n_link) a line of the cache each
    double *delta;            // [L] (n_link) penetration
    double *link_history;     // (model.n_link_history)

    // Ground motions, all (n_ground)
    double *ground_a, *ground_v, *ground_u;  // [L/T^2] [L/T] [L]
};
extern const struct fields state_fields;

// What has been found to be short enough for a contact.
struct resolved {
    double step;   // [T] with which the start or the end of a step was last resolved; 0: none
    double depth;  // [L] penetration up to which steps are short enough for its spring,
    long factors;  // work.factors with which that is so
};

// What Newmark's method remembers from step to step besides its states. It is not physical, but the
// last bits of the results depend on it.
struct memory {
    double *tangent;            // [F/L] (n_dof) of the storeys when they were last linearised
    double *part_tangent;       // (model.n_part_tangent) of the parts of predictable buildings
    struct resolved *resolved;  // (n_link)
    int unresolved;             // link that last needed a shorter step; -1: none did
};
extern const struct fields state_memory_fields;

// Room for a state of the model in `a`; false: no memory.
bool state_alloc(struct state *s, const struct model *m, struct arena *a);

// Room for the memory of a run that has taken no step; false: no memory.
bool state_memory_alloc(struct memory *s, const struct model *m, struct arena *a);

// Asserts the zeros around arrays of floors, which loops read as the ground and as walls.
void state_assert(const struct state *s, const struct model *m);

// Empties `live`: all links open, with force 0.
void state_open_links(struct state *s);

// Takes link k into `live`, if it is not there. In line, as each step does it anew.
static inline void state_enliven(struct state *s, int k) {
    if (!s->link[k].is_live) {
        s->link[k].is_live = true;
        s->link[k].n_past = 0;
        int i = s->n_live++;
        for (; i > 0 && s->live[i - 1] > k; i--) {
            s->live[i] = s->live[i - 1];
        }
        s->live[i] = k;
    }
}

// What the next step begins with of a link that was `from`, closed, and stays so: its force is
// still that of the last step, and it remembers `most` past forces at most.
static inline struct link_state state_carry_on(const struct link_state *from, int most) {
    return (struct link_state){
        .force = from->force,
        .past = {from->force, from->past[0], from->past[1]},
        .t_close = from->t_close,
        .v_close = from->v_close,
        .n_past = from->n_past < most ? from->n_past + 1 : most,
        .is_live = true,
        .closed = true,
    };
}

// Opens link k and takes it out of `live`.
void state_open_link(struct state *s, int k);

// Opens the live links of which `opens` is true.
typedef bool state_question(const struct state *s, const struct model *m, int k);
void state_open_where(struct state *s, const struct model *m, state_question *opens);

// Brings the histories of closed links to the penetrations of a solved state.
void state_commit_links(struct state *s, const struct model *m);

// The penetration of link k at the displacements of `s` [L], the velocity at which it grows [L/T]
// and the rate of that at the accelerations of `s` [L/T^2].
double state_penetration(const struct state *s, const struct model *m, int k);
double state_rate(const struct state *s, const struct model *m, int k);
double state_pressing(const struct state *s, const struct model *m, int k);

// Sets the displacements of the struck points of columns that yield, in an array of degrees of
// freedom, to those of elastic columns with the same forces (struck_column_elastic).
void state_struck(const struct state *s, const struct model *m, double *u);

// Closes link k at this instant: history and force from the velocity it closes with.
void state_close_link(struct state *s, const struct model *m, int k);

// The force of the law of link k at its penetration and velocity, with its history as it is.
double state_link_force(const struct state *s, const struct model *m, int k);

// Whether link k is a rigid contact at rest.
bool state_rests(const struct state *s, const struct model *m, int k);

// Are all storeys elastic, and without parts beside them?
static inline bool state_is_linear(const struct model *m) {
    return m->n_storey_history == 0 && !m->chain.parts;
}

// Does one ground move all floors, and nothing else from outside?
static inline bool state_is_uniform(const struct model *m) {
    return m->n_ground == 1 && m->n_load == 0;
}

// Sets drifts and storey shears to the displacements and velocities of `s`, from the storey history
// `from`. `after` becomes what a step which ends at these drifts commits, and may be `from` itself;
// NULL: it is not wanted.
void state_forces(struct state *s, const struct model *m, const double *from, double *after);

// Parts of that, after the chain's: shears and tangents of the storeys of building g; then the
// shears of its parts, at the drift rates of `s`. `after` as in struct storey_law.
void state_storeys(struct state *s, const struct model *m, const struct building *g,
                   const double *from, double *after);
void state_parts(struct state *s, const struct building *g, const double *from, double *after);

// The drift rates of building g, of the velocities v (n_dof), if its parts may read them.
void state_rates(struct state *s, const struct building *g, const double *v);

// Computes what steps leave out: accelerations of the ground, external forces and total
// accelerations, and those of linear models drifts and internal forces. Adaptive steps have the
// external forces already.
void state_complete(struct state *s, const struct model *m);

// total = a + base.
void state_totals(struct state *s, const struct model *m);

// Where an end of link l that is no row stands in the arrays (n_dof); a wall is the zero behind
// them.
static inline int state_end(const struct link *l, const struct model *m, int side) {
    return l->dof[side] == WALL ? m->n_dof : l->dof[side];
}

// Penetration of link l before its gap is taken off, from displacements u and those of the grounds
// (or its rate from velocities); and the grounds' share of that, 0 where both ends stand on the
// same ground. In line for the contact iteration.
static inline double state_ground_gap(const struct link *l, const struct model *m,
                                      const double *ground) {
    return l->moving_ground ? ground[m->building[l->building[0]].ground] -
                                  ground[m->building[l->building[1]].ground]
                            : 0.0;
}

static inline double state_gap(const struct link *l, const struct model *m, const double *u,
                               const double *ground) {
    return link_across(l, u) + state_ground_gap(l, m, ground);
}

// Adds to x (n_dof) what a force f of link l does to the accelerations of its floors, or an impulse
// to their velocities.
void state_push(const struct link *l, const struct model *m, double f, double *x);

// Adds to `floor` (n_dof) the forces of the live links on the floors.
void state_add_link_forces(const struct state *s, const struct model *m, double *floor);

// Bound on the rounding error of the difference of `x` (n_dof) between both ends of a link.
double state_rounding(const struct link *l, const double *x);

#endif
