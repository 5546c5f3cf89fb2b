// SPDX-License-Identifier: GPL-3.0-or-later
// Free flight: steps of the model's size in which no link acts. They need no iteration and no
// search, and most steps are such, so they have a way of their own through the solver. It gives the
// same bits as newmark_step, energy_step and peaks_update.
#ifndef JOSTLE_FLIGHT_H
#define JOSTLE_FLIGHT_H

#include "solve/account.h"
#include "solve/work.h"

// Ground accelerations computed at a time.
enum { FLIGHT_AHEAD = 64 };

// Contacts that follow each other, as do the floors at both their ends: LANES_WIDTH at most.
struct gap_group {
    int contact;    // the first
    int dof[2];     // its ends; a wall is the zero behind the floors
    int ground[2];  // that move them apart; the same where none does
};

struct flight {
    const struct model *model;  // borrowed, as are the next three
    struct work *work;
    struct results *results;
    struct energy_account *energy;
    bool possible;            // with this model
    struct gap_group *group;  // (n_group)
    int n_group;
    double *gap;                 // [L] (n_group, LANES_WIDTH) infinite where a group has no contact
    long ahead_from;             // step of the first of the accelerations computed ahead
    double ahead[FLIGHT_AHEAD];  // [L/T^2] of the ground, where there is one
};

// Room for the flights of a model; false: no memory.
bool flight_alloc(struct flight *f, const struct model *m, struct arena *a);

// Steps from step `n` of the model, whose state is `*now`, as far as step `end`, but stops before a
// step in which a link would act. Returns the step that it has reached; `*now` is its state, and
// `*next` is of no meaning.
long flight_take(struct flight *f, struct state **now, struct state **next, long n, long end);

// What a step may turn out to be.
enum flight_outcome {
    FLIGHT_GOES_ON,
    FLIGHT_PEAK,   // something may be greater than it was ever before, or is not finite
    FLIGHT_MEETS,  // a contact closes: the step is not taken
};

// Displacements, velocities, accelerations and damping forces of `next`, whose base and external
// forces are there, and the works of the step.
enum flight_outcome flight_step(const struct flight *f, const struct state *now,
                                struct state *next);

#endif
