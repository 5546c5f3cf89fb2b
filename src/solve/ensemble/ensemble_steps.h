// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of struct ensemble_steps, by the loops of floor_step.h on vectors of runs: STEPS is
// their name, and SOLVE their function for contacts. Each lane goes through the operations of a run
// alone in the same order, so its bits are the same. Vectors that hold half of the lanes take one
// part after the other, number p.
//
// A few buildings are taken through the whole step before the next ones, while their numbers are at
// hand. Works and peaks of a step are taken by the next one, as floors.h says.
#ifndef JOSTLE_ENSEMBLE_STEPS_H
#define JOSTLE_ENSEMBLE_STEPS_H

#include <stddef.h>
#include <string.h>

#include "solve/ensemble/ensemble_lanes.h"
#include "solve/floors/floor_step.h"

// Buildings that are taken through a step together. While the processor waits in the substitution
// of one, where each floor needs the one before, it goes on with the next.
enum { TOGETHER = 2 };

// Floors whose corrections are computed together, so that as many sums are under way at once; those
// left over at the end join the last group.
enum { ROWS = 4, ROWS_MOST = 2 * ROWS - 1 };
#define EACH_ROW(c, n) _Pragma("GCC unroll 8") for (int c = 0; c < (n); c++)

// A function that stays one: compilers mix up what is in others.
#define APART FLOORS_CLONES __attribute__((noinline)) static

static_assert(sizeof(struct ensemble_state) == MOTION_PITCH * sizeof(wide) &&
                  sizeof(struct ensemble_trial) == MOTION_PITCH * sizeof(wide) &&
                  sizeof(struct ensemble_peaks) == PEAK_PITCH * sizeof(wide) &&
                  (int)NUMBER_COUNT == (int)CHAIN_PITCH,
              "what belongs to a floor is together");

// Part p of the lanes from x on.
LANES_INLINE double *part_of(wide *x, int p) {
    return (double *)x + (ptrdiff_t)p * FLOORS_VECTOR;
}

// All bits of the lanes of part p that a run is in.
LANES_INLINE void find_active(const struct ensemble_lanes *e, int p, floor_bits *active) {
    memcpy(active, e->active + (ptrdiff_t)p * FLOORS_VECTOR, sizeof *active);
}

// The same of numbers of a model.
LANES_INLINE const double *held_part(const double *x, bool once, int p) {
    return once ? x : x + (ptrdiff_t)p * FLOORS_VECTOR;
}

// The numbers of a building.
LANES_INLINE struct chain chain_of(const struct ensemble_building *b, bool once, int p) {
    const double *x = held_part(b->number, once, p);
    const ptrdiff_t next = once ? 1 : WIDE_RUNS;
    return (struct chain){.mass = x + NUMBER_MASS * next,
                          .stiffness = x + NUMBER_STIFFNESS * next,
                          .damping_below = x + NUMBER_BELOW * next,
                          .damping = x + NUMBER_OWN * next,
                          .damping_above = x + NUMBER_ABOVE * next};
}

LANES_INLINE struct floors_motion motion_of(struct ensemble_state *s, int p) {
    return (struct floors_motion){
        .u = part_of(&s->u, p), .v = part_of(&s->v, p), .a = part_of(&s->a, p)};
}

// Building `b` in the step under way; its trial stands at `trial`.
LANES_INLINE struct floors_pass pass_of(const struct ensemble_lanes *e,
                                        const struct ensemble_building *b, bool once, int p,
                                        const wide *ground, ptrdiff_t trial) {
    const int first = b->shape->first;
    const struct ensemble_factors *f = e->factors;
    struct ensemble_trial *t = &e->trial[trial];
    return (struct floors_pass){
        .chain = chain_of(b, once, p),
        .once = once,
        .now = motion_of(e->now + first, p),
        .next = motion_of(e->next + first, p),
        .ground = FLOORS_AT((const double *)ground + (ptrdiff_t)p * FLOORS_VECTOR, 0),
        .h = f->h[0],
        .half = f->half[0],
        .b = f->b[0],
        .g = f->g[0],
        .residual = part_of(&t->residual, p),
        .u_trial = part_of(&t->u, p),
        .v_trial = part_of(&t->v, p),
    };
}

// Takes the step from `next`, which it led from, to `now`, of the floors of building `b`.
LANES_INLINE void account_floors(const struct ensemble_lanes *e, const struct ensemble_building *b,
                                 bool once, int p) {
    const ptrdiff_t first = b->shape->first;
    double *peak[PEAK_COUNT], *peak_time[PEAK_COUNT];
    for (int q = 0; q < PEAK_COUNT; q++) {
        peak[q] = part_of(&e->peak[first].of[q], p);
        peak_time[q] = part_of(&e->peak_time[first].of[q], p);
    }
    struct ensemble_works *w = e->works;
    struct floors_taken step = {
        .chain = chain_of(b, once, p),
        .once = once,
        .s0 = motion_of(e->next + first, p),
        .s1 = motion_of(e->now + first, p),
        .ground = FLOORS_AT(part_of(&w->ground, p), 0),
        .ground_2x = FLOORS_AT(part_of(&w->ground_2x, p), 0),
        .time = w->time,
        .peak = peak,
        .peak_time = peak_time,
        .first = first,
    };
    find_active(e, p, &step.active);
    const int n = b->shape->n_floor;
    floor_bits *beyond = (floor_bits *)&w->beyond + p;
    if (floors_take(&step, 0, n, part_of(w->input_2x, p), part_of(w->damping_2x, p))) {
        const double *all = part_of(e->peak[first].of, p);
        for (ptrdiff_t i = 0; i < (ptrdiff_t)n * PEAK_PITCH; i++) {
            *beyond |= BEYOND(FLOORS_AT(all, i), ENSEMBLE_LARGEST + none);
        }
    }
}

// `count` corrections from floor j on, by as many rows of the inverse, which is stored by columns.
LANES_INLINE void multiply_rows(const double *inverse, bool once, const double *r, int n, int j,
                                int count, double *q) {
    floor_lanes sum[ROWS_MOST];
    EACH_ROW(c, count) {
        sum[c] = none;
    }
    for (ptrdiff_t i = 0, at = j; i < n; i++, at += n) {
        EACH_ROW(c, count) {
            sum[c] += MOTION_AT(r, i) * HELD_AT(once, inverse, at + c);
        }
    }
    EACH_ROW(c, count) {
        FLOORS_SET(q, (ptrdiff_t)j + c) = sum[c];
    }
}

#define CASE_OF_ROWS(count)                                                                        \
    case count:                                                                                    \
        multiply_rows(inverse, once, r, n, j, count, q);                                           \
        break

LANES_INLINE void multiply(const double *inverse, bool once, const double *r, int n, double *q) {
    int j = 0;
    for (; j + ROWS_MOST < n; j += ROWS) {
        multiply_rows(inverse, once, r, n, j, ROWS, q);
    }
    switch (n - j) {
        CASE_OF_ROWS(1);
        CASE_OF_ROWS(2);
        CASE_OF_ROWS(3);
        CASE_OF_ROWS(4);
        CASE_OF_ROWS(5);
        CASE_OF_ROWS(6);
        CASE_OF_ROWS(ROWS_MOST);
    }
}

#define FACTOR_AT(i, q) HELD_AT(once, x, (i)*FACTOR_COUNT + FACTOR_##q)

// L D L^T, from the ground up and back.
LANES_INLINE void substitute(const double *x, bool once, const double *r, int n, double *q) {
    const ptrdiff_t top = n - 1;
    floor_lanes below = MOTION_AT(r, 0);
    FLOORS_SET(q, 0) = below;
    for (ptrdiff_t i = 1; i < n; i++) {
        below = MOTION_AT(r, i) - FACTOR_AT(i - 1, OFF) * below;
        FLOORS_SET(q, i) = below;
    }
    floor_lanes above = below * FACTOR_AT(top, PIVOT);
    FLOORS_SET(q, top) = 0.0 + above;
    for (ptrdiff_t i = top - 1; i >= 0; i--) {
        above = FLOORS_AT(q, i) * FACTOR_AT(i, PIVOT) - FACTOR_AT(i, OFF) * above;
        FLOORS_SET(q, i) = 0.0 + above;
    }
}

// The corrections of building `b`.
LANES_INLINE void solve(const struct floors_pass *pass, const struct ensemble_building *b, int p,
                        double *q) {
    const bool once = pass->once;
    const int n = b->shape->n_floor;
    if (b->multiplies) {
        multiply(held_part(b->inverse, once, p), once, pass->residual, n, q);
    } else {
        substitute(held_part(b->factor, once, p), once, pass->residual, n, q);
    }
}

LANES_INLINE void begin_by(const struct ensemble_lanes *e, const struct ensemble_building *b,
                           bool once, int p, const wide *ground, ptrdiff_t trial) {
    const struct floors_pass pass = pass_of(e, b, once, p, ground, trial);
    floor_bits beyond = {0};
    floors_begin(&pass, 0, b->shape->n_floor, NULL, &beyond);
}

APART void begin_once(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                      const wide *ground, ptrdiff_t trial) {
    begin_by(e, b, true, p, ground, trial);
}

APART void begin_each(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                      const wide *ground, ptrdiff_t trial) {
    begin_by(e, b, false, p, ground, trial);
}

LANES_INLINE void end_by(const struct ensemble_lanes *e, const struct ensemble_building *b,
                         bool once, int p, const wide *ground, ptrdiff_t trial) {
    floor_bits beyond = {0};
    const struct floors_pass pass = pass_of(e, b, once, p, ground, trial);
    double *q = part_of(e->correction + b->shape->first, p);
    solve(&pass, b, p, q);
    if (e->owing) {
        account_floors(e, b, once, p);
    }
    floors_finish(&pass, 0, b->shape->n_floor, q, &beyond);
}

APART void end_once(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                    const wide *ground, ptrdiff_t trial) {
    end_by(e, b, true, p, ground, trial);
}

APART void end_each(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                    const wide *ground, ptrdiff_t trial) {
    end_by(e, b, false, p, ground, trial);
}

LANES_INLINE void begin(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                        const wide *ground, ptrdiff_t trial) {
    b->held == HELD_ONCE ? begin_once(e, b, p, ground, trial) : begin_each(e, b, p, ground, trial);
}

LANES_INLINE void end(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                      const wide *ground, ptrdiff_t trial) {
    b->held == HELD_ONCE ? end_once(e, b, p, ground, trial) : end_each(e, b, p, ground, trial);
}

// Computes `next` of part p, with few trials at a time.
LANES_INLINE void step(const struct ensemble_lanes *e, int p, const wide *ground) {
    const struct ensemble_building *b = e->building;
    for (int first = 0; first < e->n_building; first += TOGETHER) {
        const int last = first + TOGETHER < e->n_building ? first + TOGETHER : e->n_building;
        const int floor = b[first].shape->first;
        for (int k = first; k < last; k++) {
            begin(e, &b[k], p, ground, b[k].shape->first - floor);
        }
        for (int k = first; k < last; k++) {
            end(e, &b[k], p, ground, b[k].shape->first - floor);
        }
    }
}

// What contacts of `next` ask for: negative where one is closed, and where one is nearer than ever.
LANES_INLINE void approach(const struct ensemble_lanes *e, int p, floor_bits *closed,
                           floor_bits *nearer) {
    const double *u = part_of(&e->next->u, p);
    for (int k = 0; k < e->n_contact; k++) {
        struct ensemble_gap *c = &e->gap[k];
        const floor_lanes d = MOTION_AT(u, e->end[k][0]) - MOTION_AT(u, e->end[k][1]) -
                              FLOORS_AT(part_of(&c->width, p), 0);
        *closed |= (floor_bits)(0.0 - d);
        *nearer |= (floor_bits)(FLOORS_AT(part_of(&c->limit, p), 0) - d);
    }
}

FLOORS_CLONES static int march(struct ensemble_lanes *e, const wide *base, int n, long first) {
    for (int i = 0; i < n; i++) {
        floor_bits ends = {0}, nears = {0};
        for (int p = 0; p < FLOORS_PARTS; p++) {
            floor_bits active, closed = {0}, nearer = {0};
            find_active(e, p, &active);
            step(e, p, base + i);
            approach(e, p, &closed, &nearer);
            ends |= (closed | ((const floor_bits *)&e->works->beyond)[p]) & active;
            nears |= nearer & active;
        }
        e->owing = false;
        if (floors_any(&ends)) {
            return i;
        }
        const double time = (double)(first + i) * e->h;
        if (floors_any(&nears)) {
            ensemble_press(e);
            ensemble_approach(e, time);
        }
        ensemble_commit(e, base + i, time);
    }
    return n;
}

// The forces that live links begin the step with, link by link as a run alone takes them.
LANES_INLINE void push(struct ensemble_lanes *e) {
    for (int k = 0; k < e->n_contact; k++) {
        if (e->acts[k]) {
            e->trial[e->end[k][0]].residual -= e->force[k];
            e->trial[e->end[k][1]].residual += e->force[k];
            e->force[k] = (wide){0.0};
        }
        e->acts[k] = false;
    }
}

FLOORS_CLONES static void move(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building * FLOORS_PARTS; k++) {
        const struct ensemble_building *b = &e->building[k / FLOORS_PARTS];
        begin(e, b, k % FLOORS_PARTS, base, b->shape->first);
    }
    push(e);
    for (int k = 0; k < e->n_building * FLOORS_PARTS; k++) {
        const struct ensemble_building *b = &e->building[k / FLOORS_PARTS];
        end(e, b, k % FLOORS_PARTS, base, b->shape->first);
    }
    e->owing = false;
}

FLOORS_CLONES static void move_pushed(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_building *b = &e->building[k];
        const ptrdiff_t first = b->shape->first;
        for (int p = 0; b->pushed && p < FLOORS_PARTS; p++) {
            const struct floors_pass pass = pass_of(e, b, false, p, base, first);
            floor_bits beyond = {0};
            floors_finish(&pass, 0, b->shape->n_floor, part_of(e->correction + first, p), &beyond);
        }
        b->pushed = false;
    }
}

FLOORS_CLONES static void catch_up(struct ensemble_lanes *e) {
    if (!e->owing) {
        return;
    }
    for (int k = 0; k < e->n_building; k++) {
        const struct ensemble_building *b = &e->building[k];
        for (int p = 0; p < FLOORS_PARTS; p++) {
            b->held == HELD_ONCE ? account_floors(e, b, true, p) : account_floors(e, b, false, p);
        }
    }
    e->owing = false;
}

const struct ensemble_steps STEPS = {
    .march = march,
    .move = move,
    .solve = SOLVE,
    .move_pushed = move_pushed,
    .catch_up = catch_up,
};

#endif
