// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in lockstep, from step to step.
#ifndef JOSTLE_ENSEMBLE_LOCKSTEP_H
#define JOSTLE_ENSEMBLE_LOCKSTEP_H

#include "solve/ensemble/ensemble_lanes.h"

enum slot_mode {
    SLOT_IN_LANES,     // in the lanes
    SLOT_ALONE,        // in a struct run, for a step
    SLOT_STAYS_ALONE,  // in a struct run for good
    SLOT_ENDED,        // after its last step, or with an error
};

// A run in lockstep with others, and its lane.
struct slot {
    struct run run;
    struct ensemble_member *member;  // borrowed
    enum slot_mode mode;
    int ground;            // the first run whose ground moves as that of this one
    long entered;          // the step after which it entered its lane
    struct totals before;  // a step in which its links act
};

struct lockstep {
    struct ensemble_lanes lanes;
    const struct observer *observer;  // borrowed
    int n;
    struct slot slot[ENSEMBLE_MAX];  // (n) slot k has lane k
    int n_in_lanes, n_alone;
    // Bits of runs in lanes:
    unsigned live;    // their committed states have live links,
    unsigned acting;  // links act in the step under way outside of the lanes,
    unsigned wanted;  // and their forces are still to be solved for
    long due;         // the step after which a run has but its last one, which may be shorter
    long known;       // ground accelerations are there up to this step
    int every;        // steps between two rows
};

// ensemble_run by steps of one kind, which the processor must have.
void ensemble_run_by(const struct ensemble_steps *steps, struct ensemble_member *member, int n,
                     const struct observer *observer);

// Lets a run enter its lane after step n, if it may.
void ensemble_lockstep_enter(struct lockstep *l, int k, long n);

// Lets it leave the lane after step n, to go on alone.
void ensemble_lockstep_leave(struct lockstep *l, int k, long n);

// Ends a run for good, with the status of its steps.
void ensemble_lockstep_end(struct lockstep *l, int k, int status);

// Takes the runs in lanes from step n on to a step at which there is something to do for one of the
// runs, and returns it.
long ensemble_lockstep_advance(struct lockstep *l, long n);

#endif
