// SPDX-License-Identifier: GPL-3.0-or-later
// The right-hand side of the equations of motion on the branches of struct dp_system.
#ifndef JOSTLE_DP_RATES_H
#define JOSTLE_DP_RATES_H

#include "solve/dormand_prince/dp_system.h"

// The system at one instant. Links are those live in the state at the start of the step.
struct dp_rates {
    double *u, *v;                 // [L] [L/T] (n_dof)
    double *a;                     // [L/T^2] (n_dof)
    struct forcing_values ground;  // (n_ground)
    double *force;                 // [F] (n_live)
    double *power;                 // [F L/T] (n_live) of those forces
    double *dfdd, *dfdv;           // [F/L] [F T/L] (n_live) their slopes
    // [F L/T] of loads, of full dampings and on storeys that are not elastic; not where nothing is
    // special
    double input, damping, storey;
};

extern const struct fields dp_rates_fields;

// Room for rates; false: no memory.
bool dp_rates_alloc(struct dp_rates *r, const struct model *m, struct arena *a);

// Whose rates are asked for: those of one building, by its index, or of all.
enum { DP_ALL = -1 };

// Accelerations, forces and powers at time t from r->u and r->v, with the histories of `now`: those
// of linear floors (dp_floors.h), and what dp_rates_add adds to them. Of one building the motions
// are needed of all that its links join it to.
void dp_rates_add(const struct dp_system *s, const struct state *now, double t, int building,
                  struct dp_rates *r);
void dp_rates_at(const struct dp_system *s, const struct state *now, double t, int building,
                 struct dp_rates *r);

// The floors of those in whole lanes, from the first up to the second.
struct dp_range {
    int first, end;
};
static inline struct dp_range dp_rates_range(const struct model *m, int building) {
    if (building == DP_ALL) {
        return (struct dp_range){0, lanes_whole(m->n_dof)};
    }
    const struct building *g = &m->building[building];
    return (struct dp_range){lanes_whole(g->first + 1) - LANES_WIDTH,
                             lanes_whole(g->first + g->n_floor)};
}

// The ground's motion at time t into r->ground. Returns its acceleration where there is one ground
// only, else 0.
static inline double dp_rates_ground(const struct dp_system *s, double t, struct dp_rates *r) {
    if (s->model->n_ground == 1 && !s->forcing.sines) {
        return r->ground.a[0] = forcing_lines(&s->forcing, 0, t);
    }
    forcing_ground(&s->forcing, t, &r->ground);
    return s->model->n_ground == 1 ? r->ground.a[0] : 0.0;
}

#endif
