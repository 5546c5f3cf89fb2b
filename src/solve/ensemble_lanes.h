// SPDX-License-Identifier: GPL-3.0-or-later
// The state of up to WIDE_RUNS runs of models of the same shape, a value of each in a lane. Lanes
// of runs that are not aboard hold numbers without meaning.
#ifndef JOSTLE_ENSEMBLE_LANES_H
#define JOSTLE_ENSEMBLE_LANES_H

#include "core/lanes.h"
#include "solve/run.h"

// Steps whose ground accelerations are computed ahead.
enum { ENSEMBLE_STRETCH = 64 };

// With numbers of the model and of the state no larger than this, nothing in a step or in an energy
// can overflow: the largest are products of seven of them.
static const double ENSEMBLE_LARGEST = 1e40;

// What a step changes of a floor.
struct ensemble_state {
    wide u, v, a;  // [L] [L/T] [L/T^2] relative to the ground
};

// What a step needs of a floor besides, with the storey below it.
struct ensemble_floor {
    wide inertia;            // [M] minus the mass
    wide stiffness;          // [F/L]
    wide below, own, above;  // [F T/L] bands of C
    wide peak[PEAK_COUNT];   // since the run came aboard, or before: never above that of the run
};

// Of A = L D L^T.
struct ensemble_factor {
    wide pivot, factor;
};

struct ensemble_peak_times {
    wide of[PEAK_COUNT];  // [T]
};

struct ensemble_contact {
    wide gap;           // [L]
    wide deepest;       // [L] as the peaks
    wide deepest_time;  // [T]
    int left, right;    // floors; a wall is the zero behind them
};

// As of struct energy_account, and the ground acceleration of `now` [L/T^2].
struct ensemble_works {
    wide input_2x[LANES_WIDTH], damping_2x[LANES_WIDTH];
    wide ground;
};

struct ensemble_lanes {
    // The shape, and the steps: those of the first model.
    int n_building, n_floor, n_contact;
    const struct building *building;  // borrowed
    double b, g, h;                   // beta h^2, gamma h and h

    long long aboard[WIDE_RUNS];            // all bits of the lanes whose runs are aboard
    struct ensemble_floor *floor;           // (n_floor) of all buildings
    struct ensemble_state *now, *next;      // (n_floor)
    struct ensemble_contact *contact;       // (n_contact)
    struct ensemble_works *works;           // so far
    struct ensemble_factor *factor;         // (n_floor)
    wide **inverse;                         // (n_building) A^-1 of each (n_floor, n_floor), or
                                            // NULL: factors
    wide *residual, *correction;            // [F] [L/T^2] (n_floor) scratch of a building
    struct ensemble_peak_times *peak_time;  // (n_floor)
    wide *base;  // [L/T^2] (ENSEMBLE_STRETCH) ground accelerations of coming steps
};

// Room for the runs of models like `m`; false: no memory.
bool ensemble_lanes_alloc(struct ensemble_lanes *e, const struct model *m, struct arena *a);

// Gives a lane the numbers of a run, whose home factors are there. False: one is so large that
// steps in lanes might overflow.
bool ensemble_lanes_fill(struct ensemble_lanes *e, int lane, struct run *r);

// Takes the committed state of a run without live links aboard. False: a number is too large.
bool ensemble_board(struct ensemble_lanes *e, int lane, const struct run *r);

// Gives a run the state of its lane, at time `time`, after `n_step` steps aboard.
void ensemble_leave(struct ensemble_lanes *e, int lane, struct run *r, double time, long n_step);

// Takes the envelopes of a lane into those of its run, at the end.
void ensemble_lanes_merge(const struct ensemble_lanes *e, int lane, struct results *r);

// Takes up to `n` steps, of which the ground accelerations are in `base`, until one of them asks
// for a closer look: that one is computed, but not committed. Returns the number committed.
int ensemble_march(struct ensemble_lanes *e, const wide *base, int n);

// The lanes aboard that cannot take the step that has been computed: links would act, or numbers
// have grown too large. One bit each. `base` is its ground acceleration here and below.
unsigned ensemble_leaving(const struct ensemble_lanes *e, const wide *base);

// Takes the step that has been computed, to `time`, into the peaks of those aboard.
void ensemble_raise(struct ensemble_lanes *e, const wide *base, double time);

// Takes its works into account and commits it.
void ensemble_commit(struct ensemble_lanes *e, const wide *base);

// The energies of all lanes (WIDE_RUNS).
void ensemble_sums(const struct ensemble_lanes *e, struct energy_sums *sums);

#endif
