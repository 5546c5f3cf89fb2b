// SPDX-License-Identifier: GPL-3.0-or-later
// A step of Newmark's method over floors, on the vectors of floor_vectors.h, by the arithmetic of
// floor_terms.h:
//     floors_take       works of the last step, and whether the state it led to exceeds a peak
//     floors_begin      the trial from that state, and its residuals
//     (the solution)    A q = r, building by building
//     floors_finish     the end of the step
// Arrays are those of core/lanes.h; first, n and `end` are whole lanes. Loops over a constant
// number of floors are unrolled, so that those of few floors stay in registers.
#ifndef JOSTLE_FLOOR_STEP_H
#define JOSTLE_FLOOR_STEP_H

#include <float.h>
#include <stddef.h>

#include "solve/floors/floor_terms.h"
#include "solve/floors/floor_vectors.h"
#include "solve/state.h"

#define EACH_VECTOR(i, first, end)                                                                 \
    _Pragma("GCC unroll 4") for (ptrdiff_t i = (first); i < (end); i += FLOORS_NEXT)

// x in lanes where all bits of a mask are set, and y where none is.
#define CHOOSE(mask, x, y) ((floor_lanes)(((mask) & (floor_bits)(x)) | (~(mask) & (floor_bits)(y))))

static const floor_lanes none = {0.0};

// Copies of pointers: what is stored may be anything, so that those behind a pointer would be read
// again after each store.
struct floors_motion {
    double *u, *v, *a, *drift, *shear;
    const double *external;  // NULL: forces of one ground
};

// The lines that storeys follow; all NULL where they are elastic. With `given`, the shears at the
// trial are known, and those at the end are left to the caller.
struct floors_lines {
    const double *back, *spring, *rest, *limit;
    const double *given;
};

// Numbers of a step; and what it leaves between its loops, from the first floor of a block on.
struct floors_pass {
    struct chain chain;
    bool once;  // its numbers are the same in all runs, and held once
    struct floors_lines lines;
    struct floors_motion now, next;
    floor_number ground;                   // acceleration at the end
    double h, half, b, g;                  // h^2 / 2, beta h^2, gamma h
    double *residual, *u_trial, *v_trial;  // [F]; the trial
};

// Drifts and shears of a vector of storeys; u_under is of the vector below. *beyond gets negative
// where a storey is beyond its line.
LANES_INLINE void floors_strain(const struct floors_pass *p, ptrdiff_t i,
                                const floor_lanes *u_under, const floor_lanes *u,
                                floor_lanes *drift, floor_lanes *shear, floor_bits *beyond) {
    *drift = *u - JOINED(p, i, BELOW(*u_under, *u));
    if (p->lines.back) {
        const floor_lanes force =
            LINE_FORCE(LINE_AT(p->lines.spring, i), LINE_AT(p->lines.rest, i), *drift);
        *beyond |= BEYOND(force, LINE_AT(p->lines.limit, i));
        *shear = LINE_SHEAR(LINE_AT(p->lines.back, i), *drift, force);
    } else {
        *shear = CHAIN_AT(p, stiffness, i) * *drift;
    }
}

// A vector of floors at the end of the step if the accelerations stay.
struct floors_trial {
    floor_lanes u, v, shear;
};

LANES_INLINE void floors_predict(const struct floors_pass *p, ptrdiff_t i, floor_lanes *u,
                                 floor_lanes *v) {
    const floor_lanes v0 = MOTION_AT(p->now.v, i), a0 = MOTION_AT(p->now.a, i);
    *u = TRIAL_U(MOTION_AT(p->now.u, i), v0, a0, p->h, p->half);
    *v = TRIAL_V(v0, a0, p->h);
}

LANES_INLINE void floors_try(const struct floors_pass *p, ptrdiff_t i, const floor_lanes *u_under,
                             struct floors_trial *t, floor_bits *beyond) {
    floor_lanes drift;
    floors_predict(p, i, &t->u, &t->v);
    if (p->lines.given) {
        t->shear = FLOORS_AT(p->lines.given, i);
    } else {
        floors_strain(p, i, u_under, &t->u, &drift, &t->shear, beyond);
    }
}

// The trial of n floors, and residual = p - M a - C v - storey shears there. `external` NULL: p is
// that of the acceleration of the ground. *beyond as above.
LANES_INLINE void floors_begin(const struct floors_pass *p, ptrdiff_t first, ptrdiff_t n,
                               const double *external, floor_bits *beyond) {
    struct floors_trial under = {none, none, none}, own, over;
    if (first > 0) {
        floors_predict(p, first - FLOORS_NEXT, &under.u, &under.v);
    }
    floors_try(p, first, &under.u, &own, beyond);
    EACH_VECTOR(i, first, first + n) {
        over = (struct floors_trial){none, none, none};
        if (i + FLOORS_NEXT < first + n) {  // what is above is of other buildings
            floors_try(p, i + FLOORS_NEXT, &own.u, &over, beyond);
        }
        const floor_lanes mass = CHAIN_AT(p, mass, i);
        const floor_lanes damping =
            BANDS(CHAIN_AT(p, damping_below, i), BELOW(under.v, own.v), CHAIN_AT(p, damping, i),
                  own.v, CHAIN_AT(p, damping_above, i), ABOVE(own.v, over.v));
        floor_lanes force = mass * -p->ground;
        if (external) {
            force = FLOORS_AT(external, i);
        }
        MOTION_SET(p->residual, i - first) =
            RESIDUAL(force - mass * MOTION_AT(p->now.a, i), damping, own.shear,
                     JOINED(p, i + 1, ABOVE(own.shear, over.shear)));
        MOTION_SET(p->u_trial, i - first) = own.u;
        MOTION_SET(p->v_trial, i - first) = own.v;
        under = own;
        own = over;
    }
}

// Stores what the correction of a vector leads to from its trial, which stands at number j; *u is
// the displacement, and *sum that of numbers that must be finite.
LANES_INLINE void floors_correct_vector(const struct floors_pass *p, ptrdiff_t i, ptrdiff_t j,
                                        const floor_lanes *change, floor_lanes *u,
                                        floor_lanes *sum) {
    const floor_lanes v = END(MOTION_AT(p->v_trial, j), p->g, *change);
    const floor_lanes a = MOTION_AT(p->now.a, i) + *change;
    *u = END(MOTION_AT(p->u_trial, j), p->b, *change);
    MOTION_SET(p->next.u, i) = *u;
    MOTION_SET(p->next.v, i) = v;
    MOTION_SET(p->next.a, i) = a;
    *sum += *u + v + a;
}

// Stores what the corrections q, from floor `first` on, lead to. *beyond as above, and where that
// is not finite, or next to it.
LANES_INLINE void floors_finish(const struct floors_pass *p, ptrdiff_t first, ptrdiff_t end,
                                const double *q, floor_bits *beyond) {
    floor_lanes sum = none, under = none, u;
    if (p->lines.back && first > 0) {
        under = MOTION_AT(p->next.u, first - FLOORS_NEXT);
    }
    EACH_VECTOR(i, first, end) {
        floors_correct_vector(p, i, i - first, &FLOORS_AT(q, i - first), &u, &sum);
        if (p->lines.back) {
            floor_lanes drift, shear;
            floors_strain(p, i, &under, &u, &drift, &shear, beyond);
            if (p->next.drift) {
                MOTION_SET(p->next.drift, i) = drift;
                MOTION_SET(p->next.shear, i) = shear;
            }
            under = u;
        }
    }
    *beyond |= BEYOND(sum, DBL_MAX + none);
}

// A step that has been taken, and where its works and the peaks of the state it led to go. Where
// storeys yield, their shears are in the states, or those of their lines.
struct floors_taken {
    struct chain chain;
    bool once;  // as above
    struct floors_lines lines;
    struct floors_motion s0, s1;
    floor_number ground, ground_2x;  // of s1, and of both together
    const double *base;              // of s1; NULL: one ground moves all floors
    double time;
    double *input_2x, *damping_2x, *storey_2x;
    double *const *peak, *const *peak_time;
    bool yields;
    ptrdiff_t first;    // of runs in lanes: the first floor of the building,
    floor_bits active;  // and all bits of lanes that a run is in
};

// Where |x| of vector i is beyond its peak, the peak and its time.
LANES_INLINE void floors_raise(const struct floors_taken *p, int quantity, ptrdiff_t i,
                               const floor_lanes *x) {
    double *peak = p->peak[quantity], *when = p->peak_time[quantity];
    const floor_lanes size = (floor_lanes)((floor_bits)*x & INT64_MAX);
    const floor_bits larger = (floor_bits)(PEAK_AT(peak, i) - size) >> 63;
    const floor_bits more = FLOORS_HEEDED(p, larger);
    PEAK_SET(peak, i) = CHOOSE(more, size, PEAK_AT(peak, i));
    PEAK_SET(when, i) = CHOOSE(more, p->time + none, PEAK_AT(when, i));
}

// The total accelerations of s1.
LANES_INLINE void floors_total(const struct floors_taken *p, ptrdiff_t i, floor_lanes *total) {
    *total = MOTION_AT(p->s1.a, i);
    if (p->base) {
        *total += FLOORS_AT(p->base, i);
    } else {
        *total += p->ground;
    }
}

// The shear of a storey at a drift, which is that of state `s`.
LANES_INLINE void floors_shear(const struct floors_taken *p, const struct floors_motion *s,
                               ptrdiff_t i, const floor_lanes *drift, floor_lanes *shear) {
    if (p->lines.back) {
        *shear =
            LINE_SHEAR(LINE_AT(p->lines.back, i), *drift,
                       LINE_FORCE(LINE_AT(p->lines.spring, i), LINE_AT(p->lines.rest, i), *drift));
    } else if (p->yields) {
        *shear = MOTION_AT(s->shear, i);
    } else {
        *shear = CHAIN_AT(p, stiffness, i) * *drift;
    }
}

// Takes the floors of s1 into the peaks.
LANES_INLINE void floors_raise_all(const struct floors_taken *p, ptrdiff_t first, ptrdiff_t end) {
    const struct floors_motion s = p->s1;
    floor_lanes under = none;
    if (first > 0) {
        under = MOTION_AT(s.u, first - FLOORS_NEXT);
    }
    for (ptrdiff_t i = first; i < end; i += FLOORS_NEXT) {
        const floor_lanes u = MOTION_AT(s.u, i), v = MOTION_AT(s.v, i);
        const floor_lanes drift = u - JOINED(p, i, BELOW(under, u));
        floor_lanes shear, total;
        floors_shear(p, &s, i, &drift, &shear);
        floors_total(p, i, &total);
        floors_raise(p, PEAK_DISPLACEMENT, i, &u);
        floors_raise(p, PEAK_VELOCITY, i, &v);
        floors_raise(p, PEAK_ACCELERATION, i, &total);
        floors_raise(p, PEAK_DRIFT, i, &drift);
        floors_raise(p, PEAK_SHEAR, i, &shear);
        under = u;
    }
}

// What the works of a vector of floors need of itself and of the one below.
struct floors_pair {
    floor_lanes u_under, u0_under, v_under, v_own;  // twice the mean velocities
};

// Adds the works of vector i, at `slot` of each. *higher gets negative where s1 is beyond a peak:
// elastic shears are so only with their drifts, as rounding is monotone.
LANES_INLINE void floors_account_vector(const struct floors_taken *p, ptrdiff_t i, ptrdiff_t slot,
                                        struct floors_pair *pair, double *input, double *damping,
                                        floor_bits *higher) {
    const floor_lanes u = MOTION_AT(p->s1.u, i), u0 = MOTION_AT(p->s0.u, i), moved = u - u0;
    const floor_lanes v = MOTION_AT(p->s1.v, i);
    const floor_lanes v_over =
        MOTION_AT(p->s0.v, i + FLOORS_NEXT) + MOTION_AT(p->s1.v, i + FLOORS_NEXT);
    if (p->s1.external) {
        FLOORS_SET(input, slot) +=
            (FLOORS_AT(p->s0.external, i) + FLOORS_AT(p->s1.external, i)) * moved;
    } else {
        FLOORS_SET(input, slot) -= WORK_OF_GROUND(p->ground_2x, CHAIN_AT(p, mass, i), moved);
    }
    const floor_lanes force = BANDS(
        CHAIN_AT(p, damping_below, i), BELOW(pair->v_under, pair->v_own), CHAIN_AT(p, damping, i),
        pair->v_own, CHAIN_AT(p, damping_above, i), ABOVE(pair->v_own, v_over));
    FLOORS_SET(damping, slot) += WORK_OF_DAMPING(moved, force);
    floor_lanes total;
    const floor_lanes drift = u - JOINED(p, i, BELOW(pair->u_under, u));
    floors_total(p, i, &total);
    if (p->yields) {
        const floor_lanes drift0 = u0 - JOINED(p, i, BELOW(pair->u0_under, u0));
        floor_lanes shear, shear0;
        floors_shear(p, &p->s0, i, &drift0, &shear0);
        floors_shear(p, &p->s1, i, &drift, &shear);
        FLOORS_SET(p->storey_2x, i) += (shear0 + shear) * (drift - drift0);
        *higher |= BEYOND(shear, PEAK_AT(p->peak[PEAK_SHEAR], i));
    }
    *higher |= BEYOND(u, PEAK_AT(p->peak[PEAK_DISPLACEMENT], i)) |
               BEYOND(v, PEAK_AT(p->peak[PEAK_VELOCITY], i)) |
               BEYOND(total, PEAK_AT(p->peak[PEAK_ACCELERATION], i)) |
               BEYOND(drift, PEAK_AT(p->peak[PEAK_DRIFT], i));
    *pair = (struct floors_pair){u, u0, pair->v_own, v_over};
}

// Whether anything is beyond its peak is asked for so many floors at once.
enum { FLOORS_ASKED = 64 };

LANES_INLINE ptrdiff_t floors_part(ptrdiff_t i, ptrdiff_t end) {
    return i + FLOORS_ASKED < end ? i + FLOORS_ASKED : end;
}

// Takes the floors from `first` to `end` into the peaks and the works, which are LANES_WIDTH
// vectors or numbers each. True: a peak has risen.
LANES_INLINE bool floors_take(const struct floors_taken *p, ptrdiff_t first, ptrdiff_t end,
                              double *input, double *damping) {
    bool rises = false;
    struct floors_pair pair = {.v_own = MOTION_AT(p->s0.v, first) + MOTION_AT(p->s1.v, first)};
    if (first > 0) {
        const ptrdiff_t under = first - FLOORS_NEXT;
        pair.u_under = MOTION_AT(p->s1.u, under);
        pair.u0_under = MOTION_AT(p->s0.u, under);
        pair.v_under = MOTION_AT(p->s0.v, under) + MOTION_AT(p->s1.v, under);
    }
    for (ptrdiff_t part = first; part < end; part = floors_part(part, end)) {
        floor_bits higher = {0};
        const ptrdiff_t part_end = floors_part(part, end);
        _Pragma("GCC unroll 2") for (ptrdiff_t i = part; i < part_end; i += FLOORS_WHOLE) {
            EACH_OF_LANES(j) {
                floors_account_vector(p, i + j * FLOORS_NEXT, FLOORS_SLOT(p, i, j), &pair, input,
                                      damping, &higher);
            }
        }
        higher = FLOORS_HEEDED(p, higher);
        if (floors_any(&higher)) {
            floors_raise_all(p, part, floors_part(part, end));
            rises = true;
        }
    }
    return rises;
}

#endif
