// SPDX-License-Identifier: GPL-3.0-or-later
// The state of up to WIDE_RUNS runs of models of the same shape, a value of each in a lane. Lanes
// of runs that are not active hold numbers without meaning.
#ifndef JOSTLE_ENSEMBLE_LANES_H
#define JOSTLE_ENSEMBLE_LANES_H

#include <string.h>

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

// Where it would be at the end of the step under way if its acceleration stayed.
struct ensemble_trial {
    wide u, v;
    wide residual;  // [F] missing to equilibrium there
};

// The same in all lanes; in memory, from where they cost least.
struct ensemble_factors {
    wide h, half;  // h and h^2 / 2
    wide b, g;     // beta h^2 and gamma h
    wide per_b, per_g;
};

// What a step needs of a floor besides, with the storey below it.
enum ensemble_number {
    NUMBER_MASS,       // [M]
    NUMBER_STIFFNESS,  // [F/L]
    NUMBER_BELOW,
    NUMBER_OWN,
    NUMBER_ABOVE,  // [F T/L] bands of C
    NUMBER_COUNT
};

// What it needs to solve A = L D L^T.
enum ensemble_factor { FACTOR_PIVOT, FACTOR_OFF, FACTOR_COUNT };

// How the numbers of a building are held.
enum ensemble_held {
    HELD_BY_EACH,  // WIDE_RUNS of each: one for every lane
    HELD_ONCE,     // one of each, where it is the same in all lanes: it takes less of the cache
};

// Number i of `x`, in functions that know how it is `held`.
#define ENSEMBLE_AT(x, i)                                                                          \
    (held == HELD_ONCE ? (x)[i] - (wide){0.0}                                                      \
                       : *(const wide *)((x) + (size_t)(i) * (size_t)WIDE_RUNS))

struct ensemble_building {
    const struct building *shape;  // borrowed: that of the first model
    enum ensemble_held held;
    double *number;   // (n_floor, NUMBER_COUNT)
    double *factor;   // (n_floor, FACTOR_COUNT)
    double *inverse;  // (n_floor, n_floor) A^-1 of a low building, else NULL
    bool multiplies;  // solves multiply by it; else they go through the factors
    bool pushed;      // links have changed its corrections since it was moved
};

// Largest values while the runs were here.
struct ensemble_peaks {
    wide of[PEAK_COUNT];
};

struct ensemble_gap {
    wide width;  // [L]
    wide limit;  // [L] a contact beyond this closes or is nearer than ever: its nearest, or
                 // infinite in lanes whose runs have taken it up in this step
};

// Largest penetrations of a contact while it is open, as the peaks.
struct ensemble_nearest {
    wide depth;  // [L]
    wide time;   // [T]
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
    wide_bits beyond;  // negative in lanes whose numbers have grown too large
};

struct ensemble_lanes;

// Steps of the floors of all runs at once; `base` is the ground acceleration at its end.
struct ensemble_steps {
    // Takes up to `n` steps, the first of them number `first`, but stops before one in which a
    // contact closes or a number grows too large. Their ground accelerations are in `base`. Returns
    // the number of steps taken.
    int (*march)(struct ensemble_lanes *e, const wide *base, int n, long first);

    // Computes one step with the forces that live links begin it with.
    void (*move)(struct ensemble_lanes *e, const wide *base);

    // Solves for the forces of contacts in lanes: see ensemble_contacts.h. NULL: none ever are.
    void (*solve)(struct ensemble_lanes *e);

    // Computes it again for buildings that links have pushed, by their corrections.
    void (*move_pushed)(struct ensemble_lanes *e, const wide *base);

    // Takes the last step into works and peaks, where that is still owing.
    void (*catch_up)(struct ensemble_lanes *e);
};
extern const struct ensemble_steps ensemble_whole;  // for registers that hold all lanes
extern const struct ensemble_steps ensemble_half;   // for those that hold half of them

struct ensemble_lanes {
    // The shape, and the steps: those of the first model.
    int n_building, n_floor, n_contact;
    double h;
    struct ensemble_factors *factors;

    long long active[WIDE_RUNS];         // all bits of the lanes that a run is in
    struct ensemble_building *building;  // (n_building)
    struct ensemble_state *now, *next;   // (n_floor) of all buildings, with zeros beyond
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

// Is a flag negative in an active lane? By halves: compilers take lanes apart one by
// one.
LANES_INLINE bool ensemble_any(const long long *active, const wide_bits *flags) {
    lanes_bits flag[2], in[2];
    memcpy(flag, flags, sizeof flag);
    memcpy(in, active, sizeof in);
    const lanes_bits any = (flag[0] & in[0]) | (flag[1] & in[1]);
    return (any[0] | any[1] | any[2] | any[3]) < 0;
}

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

// The lane takes no part any more.
void ensemble_lanes_clear(struct ensemble_lanes *e, int lane);

// Takes the envelopes of a lane into those of its run, at the end.
void ensemble_lanes_merge(const struct ensemble_lanes *e, int lane, struct results *r);

// The active lanes whose numbers have grown too large, one bit each.
unsigned ensemble_overflows(const struct ensemble_lanes *e);

// Finds the contacts that it has pressed beyond their limits in active lanes.
void ensemble_press(struct ensemble_lanes *e);

// Records those of them that are open, and so nearer than ever at `time`.
void ensemble_approach(struct ensemble_lanes *e, double time);

// Commits it, and owes its account.
LANES_INLINE void ensemble_commit(struct ensemble_lanes *e, const wide *base, double time) {
    struct ensemble_state *old = e->now;
    e->works->time = time;
    e->works->ground_2x = e->works->ground + *base;
    e->works->ground = *base;
    e->now = e->next;
    e->next = old;
    e->owing = true;
}

// The energies of all lanes (WIDE_RUNS).
void ensemble_sums(struct ensemble_lanes *e, struct energy_sums *sums);

#endif
