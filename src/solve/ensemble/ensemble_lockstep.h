// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of models of the same shape in lockstep, a run a lane. All are at the same step, so that
// they share the lanes' ground motion. Lanes of runs that are not active hold numbers without
// meaning. A run is in one of these ways in a step:
//     in a lane, with its links      all live links are contacts that have been closed for some
//                                    steps and stay so, in one group of sweep.c, or there are none
//     in a lane, without its links   a contact closes or opens: all floors take the step in lanes,
//                                    and then the links of each such run as if it were alone. In
//                                    struct run only the arrays of links, and what they need of
//                                    their floors, are up to date meanwhile
//     alone, in its struct run       a step that is rejected or split, or in which a storey leaves
//                                    its line, and the last one, which may be shorter
#ifndef JOSTLE_ENSEMBLE_LOCKSTEP_H
#define JOSTLE_ENSEMBLE_LOCKSTEP_H

#include "core/lanes.h"
#include "jostle/ensemble.h"
#include "solve/run.h"

// Steps whose ground accelerations are computed ahead.
enum { ENSEMBLE_STRETCH = 64 };

// With numbers of the model and of the state no larger than this, nothing in a step or in an energy
// can overflow: the largest are products of seven of them.
static const double ENSEMBLE_LARGEST = 1e40;

// Newton sweeps: contact.c does other things after these.
enum { ENSEMBLE_SWEEPS = 4 };

// Constants of laws whose contacts are solved for in lanes.
enum { ENSEMBLE_CONSTANTS = 2 };

// What a step changes of a floor.
struct ensemble_state {
    wide u, v, a;  // [L] [L/T] [L/T^2] relative to the ground
};

// The line that the storey below it is on: struct storey_branch.
struct ensemble_line {
    wide back, spring, rest, limit;
};

// Where it would be at the end of the step under way if its acceleration stayed.
struct ensemble_trial {
    wide u, v;
    wide residual;  // [F] missing to equilibrium there
};

// Its largest values while the runs were here, or their times.
struct ensemble_peaks {
    wide of[PEAK_COUNT];
};

// The step, the same in all lanes.
struct ensemble_scheme {
    double h, half;  // h and h^2 / 2
    double b, g;     // beta h^2 and gamma h
    double per_b, per_g;
};

// What a step needs of a floor besides, with the storey below it; and to solve A = L D L^T.
enum ensemble_number {
    NUMBER_MASS,       // [M]
    NUMBER_STIFFNESS,  // [F/L]
    NUMBER_BELOW,
    NUMBER_OWN,
    NUMBER_ABOVE,  // [F T/L] bands of C
    NUMBER_COUNT
};
enum ensemble_factor { FACTOR_PIVOT, FACTOR_OFF, FACTOR_COUNT };

struct ensemble_building {
    const struct building *shape;  // borrowed: that of the first model
    bool once;        // its numbers are the same in all lanes, and held once: less of the cache
    double *number;   // (n_floor, NUMBER_COUNT)
    double *factor;   // (n_floor, FACTOR_COUNT)
    double *inverse;  // (n_floor, n_floor) A^-1 of a low building, else NULL
    bool multiplies;  // solves multiply by it; else they go through the factors
    bool pushed;      // links have changed its corrections since it was moved
};

// Number i of `x`, an array of a building, in functions that know whether it is held `once`.
#define ENSEMBLE_AT(x, i)                                                                          \
    (once ? (x)[i] - (wide){0.0} : *(const wide *)((x) + (size_t)(i) * (size_t)WIDE_RUNS))

struct ensemble_gap {
    wide width;  // [L]
    wide limit;  // [L] a contact beyond this closes or is nearer than ever: its nearest, or
                 // infinite in lanes whose runs have taken it up in this step
};

// Largest penetrations of a contact while it is open, as the peaks. Steps without contact do not
// read them.
struct ensemble_nearest {
    wide depth, time;  // [L] [T]
};

// A contact that is beyond its limit in some lanes, a bit each:
struct ensemble_pressed {
    int contact;
    unsigned closed;  // those in which it is closed,
    unsigned nearer;  // and those in which it is open
};

// As of struct energy_account, and what an account of the last step needs.
struct ensemble_works {
    wide input_2x[LANES_WIDTH], damping_2x[LANES_WIDTH];
    double time;       // [T] of `now`,
    wide ground;       // [L/T^2] and the acceleration of the ground then,
    wide ground_2x;    // together with that before
    wide_bits beyond;  // negative in lanes whose numbers have grown too large,
    wide_bits left;    // and in those where a storey leaves its line in the step under way
};

// As struct link_peak, struct impact, struct impact_share, struct tangent and struct
// contact_response.
struct link_peak_lanes {
    wide impulse, dissipated, force, force_time;
};

struct impact_lanes {
    wide impulse, dissipated, peak_force, max_penetration;
};

struct impact_share_lanes {
    wide impulse, work, force, penetration;
};

struct tangent_lanes {
    wide base, rate, origin, reach, range, damped;
};

struct response_lanes {
    wide force, dfdd, dfdv;
};

// A contact in the lanes of active runs in which it is live. Names of the step under way are as in
// struct link_scratch.
struct closed_contact {
    wide_bits live;
    wide_bits n_past;
    wide before, past[PAST_STEPS];  // [F] force of the committed state, and of those before it
    struct link_peak_lanes link;
    wide deepest, deepest_time;
    struct impact_lanes impact;
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
    unsigned active;                 // runs whose links are here, a bit each
    unsigned solved;                 // those whose forces have been found in the step under way
    int n_acting, *acting;           // (n_contact) live in some lane, in ascending order
    wide tolerance;
    wide_bits alone;          // only one contact is live
    wide work;                // [F L] on all links so far
    wide_bits steps, sweeps;  // since the run has been here
    wide_bits count;          // sweeps of the step under way
};

struct ensemble_lanes;

// Steps of all runs at once; `base` is the ground acceleration at the end. They are made for
// processors whose registers hold all lanes or half of them.
struct ensemble_steps {
    // Takes up to `n` steps, the first of them number `first`, but stops before one in which a
    // contact closes or a number grows too large. Their ground accelerations are in `base`. Returns
    // the number of steps taken.
    int (*march)(struct ensemble_lanes *e, const wide *base, int n, long first);

    // Computes one step with the forces that live links begin it with.
    void (*move)(struct ensemble_lanes *e, const wide *base);

    // Computes it again for buildings that links have pushed, by their corrections.
    void (*move_pushed)(struct ensemble_lanes *e, const wide *base);

    // Lists the contacts that it has pressed beyond their limits in active lanes.
    void (*press)(struct ensemble_lanes *e);

    // Takes the last step into works and peaks, where that is still owing.
    void (*catch_up)(struct ensemble_lanes *e);

    bool solves;  // contacts may be in lanes
};
extern const struct ensemble_steps ensemble_whole, ensemble_half;

struct ensemble_lanes {
    // The shape, and the steps: those of the first model.
    int n_building, n_floor, n_contact;
    struct ensemble_scheme scheme;

    long long active[WIDE_RUNS];         // all bits of the lanes that a run is in
    struct ensemble_building *building;  // (n_building)
    struct ensemble_state *now, *next;   // (n_floor) of all buildings, with zeros beyond
    struct ensemble_line *line;          // (n_floor) NULL: all storeys are elastic
    wide *storey_2x;                     // [F L] (n_floor) as of struct energy_account
    const struct storey *storey;         // (n_floor) borrowed: those of the first model
    struct ensemble_trial *trial;        // (n_floor) scratch of the step under way
    wide *correction;                    // [L/T^2] (n_floor) of the accelerations in it
    wide *kept;                        // (n_floor) scratch: what they were before contacts in lanes
    struct ensemble_peaks *peak;       // (n_floor)
    struct ensemble_peaks *peak_time;  // [T] (n_floor)
    struct ensemble_works *works;      // up to `now`, or the step before where that is owing,
    bool owing;                        // which is in `next` then
    struct ensemble_gap *gap;          // (n_contact)
    struct ensemble_nearest *nearest;  // (n_contact)
    int (*end)[2];  // (n_contact) floors on both sides; a wall is the zero behind them
    wide *force;    // [F] (n_contact) that a step begins with, else 0,
    bool *acts;     // (n_contact) of contacts that are live in some lane
    struct ensemble_pressed *pressed;  // (n_contact) those beyond their limits, as last looked at
    int n_pressed;
    struct ensemble_contacts *contacts;  // of runs whose links are in lanes too
    wide *base;  // [L/T^2] (ENSEMBLE_STRETCH) ground accelerations of coming steps
    const struct ensemble_steps *steps;  // borrowed
};

// Is run k among some runs, a bit each?
static inline bool ensemble_has(unsigned runs, int k) {
    return runs >> k & 1U;
}

// The first of them from run k on; WIDE_RUNS: none.
static inline int ensemble_next(unsigned runs, int k) {
    return __builtin_ctz(runs >> k << k | 1U << WIDE_RUNS);
}

// For each of them.
#define EACH_RUN(k, runs)                                                                          \
    for (int k = ensemble_next(runs, 0); k < WIDE_RUNS; k = ensemble_next(runs, k + 1))

// Penetrations of contact k in the states `s` of all floors.
#define ENSEMBLE_PENETRATION(e, k, s)                                                              \
    ((s)[(e)->end[k][0]].u - (s)[(e)->end[k][1]].u - (e)->gap[k].width)

// Its penetration in one lane.
static inline double ensemble_depth(const struct ensemble_lanes *e, int k,
                                    const struct ensemble_state *s, int lane) {
    return s[e->end[k][0]].u[lane] - s[e->end[k][1]].u[lane] - e->gap[k].width[lane];
}

// Records the pressed contacts that are open, and so nearer than ever at `time`.
static inline void ensemble_approach(const struct ensemble_lanes *e, double time) {
    for (const struct ensemble_pressed *p = e->pressed; p < e->pressed + e->n_pressed; p++) {
        EACH_RUN(lane, p->nearer) {
            if (e->active[lane]) {
                const double depth = ensemble_depth(e, p->contact, e->next, lane);
                e->gap[p->contact].limit[lane] = depth;
                e->nearest[p->contact].depth[lane] = depth;
                e->nearest[p->contact].time[lane] = time;
            }
        }
    }
}

// Commits the step under way, and owes its account.
LANES_INLINE void ensemble_commit(struct ensemble_lanes *e, const wide *base, double time) {
    struct ensemble_state *old = e->now;
    e->works->time = time;
    e->works->ground_2x = e->works->ground + *base;
    e->works->ground = *base;
    e->now = e->next;
    e->next = old;
    e->owing = true;
}

// In ensemble_lanes.c:

// Room for the runs of models like `m`; false: no memory.
bool ensemble_lanes_alloc(struct ensemble_lanes *e, const struct model *m,
                          const struct ensemble_steps *steps, struct arena *a);

// Gives a lane the numbers of a run, whose home factors are there. False: one is so large that
// steps in lanes might overflow.
bool ensemble_lanes_fill(struct ensemble_lanes *e, int lane, struct run *r);

// Holds once what is the same in all of the first n lanes, when they have been filled.
void ensemble_lanes_share(struct ensemble_lanes *e, int n);

// Takes the floors of the committed state of a run into its lane. False: a number is too large.
bool ensemble_lanes_enter(struct ensemble_lanes *e, int lane, struct run *r);

// Gives a run the state of its lane, at time `time`, after `n_step` steps there.
void ensemble_lanes_leave(struct ensemble_lanes *e, int lane, struct run *r, double time,
                          long n_step);

// Adds up the energies of all lanes (WIDE_RUNS), whose works are not owing.
void ensemble_lanes_sum(const struct ensemble_lanes *e, struct energy_sums *sums);

// Takes the envelopes of a lane into those of its run, at the end.
void ensemble_lanes_merge(const struct ensemble_lanes *e, int lane, struct results *r);

// In ensemble_contacts.c:

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

// In ensemble_sweeps.c, for registers that hold all lanes:

// Guesses the forces of the step under way, with which the floors move.
void ensemble_contacts_begin(struct ensemble_lanes *e);

// Finds them in active runs, as contact_solve does for a run alone, and changes e->correction. Runs
// in which it has found them are `solved` then; the others must be solved for alone.
void ensemble_contacts_solve(struct ensemble_lanes *e);

// Takes the step to `time`, of length h, into impacts and peaks, and commits it.
void ensemble_contacts_commit(struct ensemble_lanes *e, double time, double h);

// From step to step: in ensemble_lockstep.c, and the first in ensemble.c.

// A run in lockstep with others, and its lane.
struct slot {
    struct run run;
    struct ensemble_member *member;  // borrowed
    int ground;                      // the first run whose ground moves as that of this one
    long entered;                    // the step after which it entered its lane
    struct totals before;            // a step in which its links act
};

struct lockstep {
    struct ensemble_lanes lanes;
    const struct observer *observer;  // borrowed
    int n;
    struct slot slot[ENSEMBLE_MAX];  // (n) slot k has lane k
    // Runs, a bit each:
    unsigned in_lanes;
    unsigned alone;  // in a struct run. Runs in neither way have ended
    unsigned fits;   // these may enter their lanes
    // Of those in lanes:
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
