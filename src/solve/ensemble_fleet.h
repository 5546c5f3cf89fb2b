// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of an ensemble. A run is
//     aboard    while its floors are in the lanes, where all runs take a step at once,
//     stowed    while its closed contacts are there too (ensemble_contacts.h),
//     ashore    for a step that only a run alone can take, in its struct run,
//     landed    for its last step, which may be shorter.
// All runs are at the same step, so that they share the lanes' ground motion.
#ifndef JOSTLE_ENSEMBLE_FLEET_H
#define JOSTLE_ENSEMBLE_FLEET_H

#include "jostle/ensemble.h"
#include "solve/ensemble_lanes.h"

enum berth {
    BERTH_ABOARD,  // in the lanes
    BERTH_ASHORE,  // in a struct run, for a step
    BERTH_STAYS,   // in a struct run for good
    BERTH_ENDED,   // with an error
};

// A run of the fleet.
struct boat {
    struct run run;
    struct ensemble_member *member;  // borrowed
    enum berth berth;
    int ground;            // the first run whose ground moves as that of this one
    long boarded;          // the step after which it came aboard
    struct totals before;  // a step in which its links act
};

struct fleet {
    struct ensemble_lanes lanes;
    const struct observer *observer;  // borrowed
    int n;
    struct boat boat[ENSEMBLE_MAX];  // (n) boat k in lane k
    int n_aboard, n_ashore;
    // Bits of runs aboard:
    unsigned live;    // their committed states have live links,
    unsigned acting;  // links act in the step under way,
    unsigned wanted;  // and their forces are still to be solved for
    long due;         // the step after which a run has but its last one, which may be shorter
    long known;       // ground accelerations are there up to this step
    int every;        // steps between two rows
};

// ensemble_run by steps of one kind, which the processor must have.
void ensemble_run_by(const struct ensemble_steps *steps, struct ensemble_member *member, int n,
                     const struct observer *observer);

// Takes a run aboard after step n, if it may.
void ensemble_fleet_board(struct fleet *f, int k, long n);

// Takes a run ashore after step n.
void ensemble_fleet_leave(struct fleet *f, int k, long n);

// Ends a run for good, with the status of its steps.
void ensemble_fleet_end(struct fleet *f, int k, int status);

// Takes those aboard from step n on to a step at which there is something to do for one of the
// runs, and returns it.
long ensemble_fleet_cruise(struct fleet *f, long n);

#endif
