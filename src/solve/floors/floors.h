// SPDX-License-Identifier: GPL-3.0-or-later
// What a step does for every floor where all storeys are elastic and all bands of C are in struct
// chain: Newmark's step and its account, a block of buildings at a time, so that what one loop
// writes the next one finds in the cache.
#ifndef JOSTLE_FLOORS_H
#define JOSTLE_FLOORS_H

#include "solve/account/energy.h"
#include "solve/state.h"

// Buildings that follow each other, and their floors, from where lanes begin to where lanes end.
struct floor_block {
    int building, n_building;
    int first, n;
    int end;  // where the next block begins: below this all is done
};

// Where the works and peaks of floors go. Where one ground moves all floors the account of a step
// is put off until the next step goes over them and overwrites the state that it began with: so
// each array comes from memory once.
struct floors_account {
    struct energy_account *energy;  // borrowed
    struct results *results;        // borrowed
    bool defers;                    // accounts are put off with this model
    bool due;         // the step to the committed state is in no works, and that state in no peaks
    double time;      // [T] of the state that the step began with,
    double ground_a;  // [L/T^2] and the acceleration of the ground then
};

struct work;
struct flight;

struct floors {
    int n_block;
    struct floor_block *block;  // (n_block)
    double *residual;           // [F] of a block
    double *u_trial, *v_trial;  // of a block: its end of the step if the accelerations stay
    struct floors_account account;
};

bool floors_alloc(struct floors *f, const struct model *m, struct arena *a);

// Works and peaks of the floors go to `energy` and `results` from now on.
void floors_account_to(struct work *w, struct energy_account *energy, struct results *results);

// Displacements, velocities, accelerations and penetrations of `next` under the forces that its
// live links have, with the trial of their buildings and the correction of all in `w`; and what
// account is due. False: not finite.
bool floors_move(struct work *w, const struct state *now, struct state *next);

// The trial of building k.
void floors_trial(struct work *w, const struct state *now, int k);

// What the corrections lead to, of n floors from `first` on. False: not finite.
bool floors_correct(const struct work *w, const struct state *now, struct state *next, int first,
                    int n);

// The same, with penetrations, where only those of buildings with live links have changed.
void floors_correct_touched(struct work *w, const struct state *now, struct state *next);

// Takes the step from `now` to `next` into works and peaks, or sees to it that a later one does.
void floors_account(struct work *w, const struct state *now, const struct state *next);

// The same at once, of a linear model or one in flight.
void floors_account_now(struct work *w, const struct state *now, const struct state *next);

// Puts that off until the next step, or until it is asked for: `next` is about to be committed, and
// the next step will be written to `now`.
void floors_defer(struct floors_account *account, const struct state *now);

// Takes what account is due: of the step that began with what is in `old`, to the committed `now`;
// and where accounts are put off, `now` itself, which steps take into the peaks only when they go
// on from it.
void floors_catch_up(struct work *w, const struct state *old, const struct state *now);

// [L/T] Largest velocity of any floor so far, up to the committed `now`, whatever is put off.
double floors_speed(const struct work *w, const struct state *now);

// A step in free flight to the time and under the ground accelerations, or where these are not
// uniform the base and external forces of `next`, and what account is due. Contacts that were
// nearest in `now` are noted. False: it is none; a contact would close, or it is not finite.
bool floors_fly(const struct flight *f, const struct state *now, struct state *next);

// The same where storeys follow straight lines; nor may one leave its line.
bool floors_fly_on_lines(const struct flight *f, const struct state *now, struct state *next);

// What of this is made of loops over floors, on vectors of one width: floors_move, floors_fly, the
// same on lines, floors_catch_up where accounts are put off, and a state taken into the peaks.
struct floors_steps {
    bool (*move)(struct work *w, const struct state *now, struct state *next);
    bool (*fly)(const struct flight *f, const struct state *now, struct state *next);
    bool (*fly_on_lines)(const struct flight *f, const struct state *now, struct state *next);
    void (*catch_up)(struct work *w, const struct state *old, const struct state *now);
    void (*raise)(struct results *r, const struct model *m, const struct state *s);
};
extern const struct floors_steps floors_narrow, floors_wide;

// Takes the forces of live links into the residual of a block, and the trial of their buildings for
// the contact iteration.
void floors_push(struct work *w, const struct state *now, const struct state *next,
                 const struct floor_block *b);

#endif
