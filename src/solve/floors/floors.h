// SPDX-License-Identifier: GPL-3.0-or-later
// What a step does for every floor: Newmark's step under given forces of links, and its account, a
// block of buildings at a time, so that each loop finds in the cache what the one before has
// written.
#ifndef JOSTLE_FLOORS_H
#define JOSTLE_FLOORS_H

#include "solve/account/account.h"
#include "solve/state.h"

// Consecutive buildings, and their floors in whole lanes.
struct floor_block {
    int building, n_building;
    int first, n;
    int end;  // where the next block begins: floors below this are finished
};

// Where the works and peaks of floors go. Where one ground moves all floors, the account of a step
// is put off until the next step, which takes it just before it overwrites the older state: so each
// array is read from memory only once.
struct floors_account {
    struct energy_account *energy;  // borrowed
    struct results *results;        // borrowed
    struct force_peaks *forces;     // borrowed; NULL: no forces follow from the drifts
    bool defers;                    // accounts are put off with this model
    bool due;         // the step to the committed state is in no works, and that state in no peaks
    double ground_a;  // [L/T^2] acceleration of the ground when that step began
};

struct effective;
struct work;
struct flight;

struct floors {
    int n_block;
    struct floor_block *block;  // (n_block)
    double *residual;           // [F] of a block
    double *u_trial, *v_trial;  // of a block: its end of the step if the accelerations stay; where
                                // there is only one block, the arrays of struct work
    double *correction;         // [L/T^2] of a block in free flight, where nothing else needs it
    struct floors_account account;
};

// Room for the floors of a model, and its blocks, when there is room for trials; false: no memory.
bool floors_alloc(struct work *w, struct arena *a);

// Sets where works and peaks of the floors go, and the states of steps in free flight for forces;
// `forces` NULL: nowhere.
void floors_account_to(struct work *w, struct energy_account *energy, struct results *results,
                       struct force_peaks *forces);

// Computes displacements, velocities, accelerations and penetrations of `next` under the forces of
// its live links, with the trial of their buildings and all corrections in `w`; and takes what
// account is due. `shear` (n_dof) is that of all storeys and parts at the trial; NULL: they are
// elastic. False: not finite.
bool floors_move(struct work *w, const struct state *now, struct state *next, const double *shear);

// Computes the trial of building k.
void floors_trial(struct work *w, const struct state *now, int k);

// Brings the buildings of `next` with live links to their corrections, and all penetrations.
void floors_correct_touched(struct work *w, const struct state *now, struct state *next);

// Takes the step from `now` to `next` into works and peaks, or puts that off until the next step or
// floors_catch_up. The caller commits `next`; `now` is where the next step will be written.
void floors_account(struct work *w, const struct state *now, const struct state *next);

// Puts that off, for a model whose accounts are.
static inline void floors_defer(struct floors_account *a, const struct state *now) {
    a->due = true;
    a->ground_a = now->ground_a[0];
}

// Takes the account that is due, of the step from the state in `old` to the committed `now`.
void floors_catch_up(struct work *w, const struct state *old, const struct state *now);

// [L/T] Largest velocity of any floor so far, that of the committed `now` included.
double floors_speed(const struct work *w, const struct state *now);

// Takes steps in free flight from number n, whose state is *now, as far as `end`, but stops before
// one in which a contact would close, a storey leave its line or a number not be finite. Returns
// the step reached; contacts that were nearest on the way are recorded.
long floors_fly(const struct flight *f, struct state **now, struct state **next, long n, long end);

// The loops over floors of these functions, on vectors of one width. `account` takes a step which
// began with ground acceleration ground_a0 into works and peaks.
struct floors_steps {
    bool (*move)(struct work *w, const struct state *now, struct state *next, const double *shear);
    void (*correct)(struct work *w, const struct state *now, struct state *next);
    long (*fly)(const struct flight *f, struct state **now, struct state **next, long n, long end);
    void (*account)(const struct work *w, const struct state *now, const struct state *next,
                    double ground_a0);
};
extern const struct floors_steps floors_narrow, floors_wide;

// Takes the forces of live links into the residual of a block, and the trial of their buildings for
// the contact iteration.
void floors_push(struct work *w, const struct state *now, const struct state *next,
                 const struct floor_block *b);

#endif
