// SPDX-License-Identifier: GPL-3.0-or-later
// Links of runs in lockstep, a run a lane. Those of a run are there while all its live links are
// contacts that have been closed for some steps and stay so, in one group of sweep.h: then the
// lanes have what struct link_state, its impact and the peaks say of them. Anything else, such as a
// contact that closes or opens, takes the links of the run out, for the functions that a run alone
// has.
#ifndef JOSTLE_ENSEMBLE_CONTACTS_H
#define JOSTLE_ENSEMBLE_CONTACTS_H

#include "solve/ensemble/ensemble_lanes.h"

// Newton sweeps: contact.c does other things after these.
enum { ENSEMBLE_SWEEPS = 4 };

// As struct tangent and struct contact_response.
struct tangent_lanes {
    wide base, rate, origin, reach, range, damped;
};

struct response_lanes {
    wide force, dfdd, dfdv;
};

// Constants of laws whose contacts are solved for in lanes.
enum { ENSEMBLE_CONSTANTS = 2 };

// A contact in the lanes of active runs in which it is live. Names of the step under way are as in
// struct link_scratch.
struct closed_contact {
    wide_bits live;
    wide_bits n_past;
    wide before, past[PAST_STEPS];  // [F] force of the committed state, and of those before it
    // Of the contact, as in struct link_peak:
    wide impulse, work, peak_force, peak_force_time, deepest, deepest_time;
    wide impact_impulse, impact_work, impact_force, impact_depth;  // and of its impact
    wide force, d_trial, v_trial, dfdd, dfdv;
    struct tangent_lanes tangent;
    wide depth;  // struct resolved
    wide_bits stale;

    wide flexibility, coupling, per_coupling;
    wide constant[ENSEMBLE_CONSTANTS];
    const struct contact_law *law;  // in all lanes
    long factors[WIDE_RUNS];        // work.factors of the run that flexibility is of; 0: none yet
    int index;                      // of the contact
    int building[2];                // at its ends; WALL
    int from[2], to[2];             // floors there that feel its force: in all lanes
    bool apart;                     // solved for run by run
};

struct ensemble_contacts {
    struct closed_contact *contact;  // (n_contact)
    unsigned *runs;                  // (n_contact) in which it is live, a bit each
    unsigned active;                 // runs that are here, a bit each
    unsigned solved;                 // those whose forces have been found in the step under way
    int n_acting, *acting;           // (n_contact) live in some lane, in ascending order
    int n_touched, *touched;         // (n_building) their buildings
    wide tolerance;
    wide_bits alone;          // only one contact is live
    wide work;                // [F L] on all links so far
    wide_bits steps, sweeps;  // since the run has been here
    wide_bits count;          // sweeps of the step under way
};

// Room for the contacts of models like `m`; NULL: no memory.
struct ensemble_contacts *ensemble_contacts_create(const struct model *m, struct arena *a);

// Gives a lane the constants of contact k of a run.
void ensemble_contacts_fill(struct ensemble_lanes *e, int lane, const struct model *m, int k);

// Takes the links of a run that is in a lane and has committed a step into it, if they can go
// there.
void ensemble_contacts_enter(struct ensemble_lanes *e, int lane, const struct run *r);

// Gives the run its links back, as they were after the last step.
void ensemble_contacts_leave(struct ensemble_lanes *e, int lane, struct run *r);

// Gives it the forces of the step under way, which it has begun, if they have been found.
void ensemble_contacts_give(struct ensemble_lanes *e, int lane, struct run *r);

// Guesses the forces of the step under way, with which the floors move.
void ensemble_contacts_begin(struct ensemble_lanes *e);

// Finds them in active runs, as contact_solve does for a run alone, and changes e->correction. It
// has not for those that are not `solved` then.
void ensemble_contacts_solve(struct ensemble_lanes *e);

// Takes the step to `time`, of length h, into impacts and peaks, and commits it.
void ensemble_contacts_commit(struct ensemble_lanes *e, double time, double h);

// Takes the work on links so far into the account of a run, if it is active.
void ensemble_contacts_work(const struct ensemble_lanes *e, int lane, struct energy_account *a);

#endif
