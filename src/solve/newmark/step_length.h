// SPDX-License-Identifier: GPL-3.0-or-later
// The length of adaptive steps of Newmark's method.
#ifndef JOSTLE_STEP_LENGTH_H
#define JOSTLE_STEP_LENGTH_H

#include "solve/forcing.h"
#include "solve/pace.h"
#include "solve/scale.h"
#include "solve/state.h"

struct step_length {
    const struct model *model;      // borrowed
    const struct results *results;  // borrowed: the peaks so far
    struct forcing forcing;         // for its corners
    struct scales scales;           // of errors
    struct pace pace;
    double trial;             // [T] what the error control would take next
    double last;              // [T] the step to the present state; 0: its accelerations jump there
    double split;             // [T] when a step was last split at an event
    bool turned;              // the forcing has a corner at the present state,
    bool jumped;              // where it jumps
    int unsolved;             // link that last needed a shorter step; -1: the tolerance did
    double *before, *within;  // [L/T^2] (n_dof) accelerations at the start of the last step: all of
                              // them, and without what the forcing does directly
};
extern const struct fields step_length_fields;

// Room for a model; false: no memory.
bool step_length_alloc(struct step_length *s, const struct model *m, const struct results *r,
                       struct arena *a);

// Begins at `now`, the state at t = 0, with a step far shorter than a row.
void step_length_start(struct step_length *s, const struct state *now);

// The next step from `now`: its size *h, and the instant *end at which it ends, at the latest
// `limit`. Errors: STATUS_FAILED (the run takes too many steps).
int step_length_next(struct step_length *s, const struct state *now, double limit, double *h,
                     double *end, struct error *e);

// Does the step of size h from `now` to `next` meet the tolerance? STATUS_RETRY: no.
int step_length_judge(struct step_length *s, const struct state *now, const struct state *next,
                      double h);

// A step of size h from `now` was rejected, by link `unsolved` or, -1, by the tolerance. Errors:
// STATUS_FAILED (it was as short as steps may be).
int step_length_reject(struct step_length *s, const struct state *now, double h, int unsolved,
                       struct error *e);

// The step of size h from `old` to `now` has been taken.
void step_length_take(struct step_length *s, const struct state *old, const struct state *now,
                      double h);

// A step was split at `now`, where the accelerations jump, or at least their rates.
void step_length_split(struct step_length *s, const struct state *now);

#endif
