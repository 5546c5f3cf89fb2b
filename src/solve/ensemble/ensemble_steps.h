// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of struct ensemble_steps, by the loops of floor_step.h on vectors of runs: STEPS is
// their name. Each lane goes through the operations of a run alone in the same order, so its bits
// are the same. Vectors that hold half of the lanes take one part after the other, number p.
//
// A few buildings are taken through the whole step before the next ones, while their numbers are at
// hand. Works and peaks of a step are taken by the next one, as floors.h says.
#ifndef JOSTLE_ENSEMBLE_STEPS_H
#define JOSTLE_ENSEMBLE_STEPS_H

#include <string.h>

#include "solve/ensemble/ensemble_lockstep.h"
#include "solve/floors/floor_step.h"

// Buildings that are taken through a step together. While the processor waits in the substitution
// of one, where each floor needs the one before, it goes on with the next.
enum { TOGETHER = 2 };

// Most floors whose corrections are computed together, so that as many sums are under way at once.
enum { ROWS = 4 };
#define EACH_ROW(c, n) _Pragma("GCC unroll 4") for (int c = 0; c < (n); c++)

#define APART FLOORS_CLONES __attribute__((noinline)) static

static_assert(sizeof(struct ensemble_state) == MOTION_PITCH * sizeof(wide) &&
                  sizeof(struct ensemble_trial) == MOTION_PITCH * sizeof(wide) &&
                  sizeof(struct ensemble_peaks) == PEAK_PITCH * sizeof(wide) &&
                  sizeof(struct ensemble_line) == LINE_PITCH * sizeof(wide) &&
                  (int)NUMBER_COUNT == (int)CHAIN_PITCH,
              "what belongs to a floor is together");

// Part p of the lanes from x on.
LANES_INLINE double *ensemble_part(wide *x, int p) {
    return (double *)x + (ptrdiff_t)p * FLOORS_VECTOR;
}

LANES_INLINE floor_bits *ensemble_flags(wide_bits *x, int p) {
    return (floor_bits *)x + p;
}

// All bits of the lanes of part p that a run is in.
LANES_INLINE void ensemble_part_active(const struct ensemble_lanes *e, int p, floor_bits *active) {
    memcpy(active, e->active + (ptrdiff_t)p * FLOORS_VECTOR, sizeof *active);
}

// The same of numbers of a model.
LANES_INLINE const double *ensemble_held_part(const double *x, bool once, int p) {
    return once ? x : x + (ptrdiff_t)p * FLOORS_VECTOR;
}

// The numbers of a building.
LANES_INLINE struct chain ensemble_chain(const struct ensemble_building *b, bool once, int p) {
    const double *x = ensemble_held_part(b->number, once, p);
    const ptrdiff_t next = once ? 1 : WIDE_RUNS;
    return (struct chain){.mass = x + NUMBER_MASS * next,
                          .stiffness = x + NUMBER_STIFFNESS * next,
                          .damping_below = x + NUMBER_BELOW * next,
                          .damping = x + NUMBER_OWN * next,
                          .damping_above = x + NUMBER_ABOVE * next};
}

LANES_INLINE struct floors_motion ensemble_motion(struct ensemble_state *s, int p) {
    return (struct floors_motion){
        .u = ensemble_part(&s->u, p), .v = ensemble_part(&s->v, p), .a = ensemble_part(&s->a, p)};
}

// The lines of the storeys from floor `first` on; none if `line` is NULL.
LANES_INLINE struct floors_lines ensemble_lines(struct ensemble_line *line, ptrdiff_t first,
                                                int p) {
    struct ensemble_line *x = line ? line + first : NULL;
    return x ? (struct floors_lines){ensemble_part(&x->back, p), ensemble_part(&x->spring, p),
                                     ensemble_part(&x->rest, p), ensemble_part(&x->limit, p), NULL}
             : (struct floors_lines){0};
}

// Building `b` in the step under way; its trial stands at `trial`.
LANES_INLINE struct floors_pass ensemble_pass(const struct ensemble_lanes *e,
                                              const struct ensemble_building *b, bool once,
                                              struct ensemble_line *line, int p, const wide *ground,
                                              ptrdiff_t trial) {
    const int first = b->shape->first;
    const struct ensemble_scheme *f = &e->scheme;
    struct ensemble_trial *t = &e->trial[trial];
    return (struct floors_pass){
        .chain = ensemble_chain(b, once, p),
        .once = once,
        .lines = ensemble_lines(line, first, p),
        .now = ensemble_motion(e->now + first, p),
        .next = ensemble_motion(e->next + first, p),
        .ground = FLOORS_AT((const double *)ground + (ptrdiff_t)p * FLOORS_VECTOR, 0),
        .h = f->h,
        .half = f->half,
        .b = f->b,
        .g = f->g,
        .residual = ensemble_part(&t->residual, p),
        .u_trial = ensemble_part(&t->u, p),
        .v_trial = ensemble_part(&t->v, p),
    };
}

// Takes the step from `next`, which it led from, to `now`, of the floors of building `b`.
LANES_INLINE void ensemble_account(const struct ensemble_lanes *e,
                                   const struct ensemble_building *b, bool once,
                                   struct ensemble_line *line, int p) {
    const ptrdiff_t first = b->shape->first;
    double *peak[PEAK_COUNT], *peak_time[PEAK_COUNT];
    for (int q = 0; q < PEAK_COUNT; q++) {
        peak[q] = ensemble_part(&e->peak[first].of[q], p);
        peak_time[q] = ensemble_part(&e->peak_time[first].of[q], p);
    }
    struct ensemble_works *w = e->works;
    struct floors_taken step = {
        .chain = ensemble_chain(b, once, p),
        .once = once,
        .lines = ensemble_lines(line, first, p),
        .yields = line != NULL,
        .storey_2x = ensemble_part(e->storey_2x + first, p),
        .s0 = ensemble_motion(e->next + first, p),
        .s1 = ensemble_motion(e->now + first, p),
        .ground = FLOORS_AT(ensemble_part(&w->ground, p), 0),
        .ground_2x = FLOORS_AT(ensemble_part(&w->ground_2x, p), 0),
        .time = w->time,
        .peak = peak,
        .peak_time = peak_time,
        .first = first,
    };
    ensemble_part_active(e, p, &step.active);
    const int n = b->shape->n_dof;
    floor_bits *beyond = ensemble_flags(&w->beyond, p);
    if (floors_take(&step, 0, n, ensemble_part(w->input_2x, p), ensemble_part(w->damping_2x, p))) {
        const double *all = ensemble_part(e->peak[first].of, p);
        for (ptrdiff_t i = 0; i < (ptrdiff_t)n * PEAK_PITCH; i++) {
            *beyond |= BEYOND(FLOORS_AT(all, i), ENSEMBLE_LARGEST + none);
        }
    }
}

// The correction of a floor, and what it leads to.
LANES_INLINE void ensemble_correct(const struct floors_pass *pass, ptrdiff_t i,
                                   const floor_lanes *change, double *q) {
    floor_lanes u, sum = none;
    FLOORS_SET(q, i) = *change;
    floors_correct_vector(pass, i, i, change, &u, &sum);
}

// That of `count` floors from floor j on, by as many rows of the inverse, which is stored by
// columns.
LANES_INLINE void ensemble_multiply_rows(const struct floors_pass *pass, const double *inverse,
                                         int n, int j, int count, double *q) {
    floor_lanes sum[ROWS];
    EACH_ROW(c, count) {
        sum[c] = none;
    }
    for (ptrdiff_t i = 0, at = j; i < n; i++, at += n) {
        EACH_ROW(c, count) {
            sum[c] += MOTION_AT(pass->residual, i) * HELD_AT(pass->once, inverse, at + c);
        }
    }
    EACH_ROW(c, count) {
        ensemble_correct(pass, (ptrdiff_t)j + c, &sum[c], q);
    }
}

LANES_INLINE void ensemble_multiply(const struct floors_pass *pass, const double *inverse, int n,
                                    double *q) {
    int j = 0;
    for (; j + ROWS <= n; j += ROWS) {
        ensemble_multiply_rows(pass, inverse, n, j, ROWS, q);
    }
    if (j + 2 <= n) {
        ensemble_multiply_rows(pass, inverse, n, j, 2, q);
        j += 2;
    }
    if (j < n) {
        ensemble_multiply_rows(pass, inverse, n, j, 1, q);
    }
}

#define FACTOR_AT(i, q) HELD_AT(pass->once, x, (i)*FACTOR_COUNT + FACTOR_##q)

// L D L^T, from the ground up and back.
LANES_INLINE void ensemble_substitute(const struct floors_pass *pass, const double *x, int n,
                                      double *q) {
    const double *r = pass->residual;
    const ptrdiff_t top = n - 1;
    floor_lanes below = MOTION_AT(r, 0);
    FLOORS_SET(q, 0) = below;
    for (ptrdiff_t i = 1; i < n; i++) {
        below = FORWARD(MOTION_AT(r, i), FACTOR_AT(i - 1, OFF), below);
        FLOORS_SET(q, i) = below;
    }
    floor_lanes above = below * FACTOR_AT(top, PIVOT), change = 0.0 + above;
    ensemble_correct(pass, top, &change, q);
    for (ptrdiff_t i = top - 1; i >= 0; i--) {
        above = BACKWARD(FLOORS_AT(q, i), FACTOR_AT(i, PIVOT), FACTOR_AT(i, OFF), above);
        change = 0.0 + above;
        ensemble_correct(pass, i, &change, q);
    }
}

LANES_INLINE void ensemble_begin_by(const struct ensemble_lanes *e,
                                    const struct ensemble_building *b, bool once,
                                    struct ensemble_line *line, int p, const wide *ground,
                                    ptrdiff_t trial) {
    const struct floors_pass pass = ensemble_pass(e, b, once, line, p, ground, trial);
    floors_begin(&pass, 0, b->shape->n_dof, NULL, ensemble_flags(&e->works->left, p));
}

LANES_INLINE void ensemble_end_by(const struct ensemble_lanes *e, const struct ensemble_building *b,
                                  bool once, struct ensemble_line *line, int p, const wide *ground,
                                  ptrdiff_t trial) {
    const struct floors_pass pass = ensemble_pass(e, b, once, line, p, ground, trial);
    double *q = ensemble_part(e->correction + b->shape->first, p);
    if (e->owing) {
        ensemble_account(e, b, once, line, p);
    }
    if (b->multiplies) {
        ensemble_multiply(&pass, ensemble_held_part(b->inverse, once, p), b->shape->n_dof, q);
    } else {
        ensemble_substitute(&pass, ensemble_held_part(b->factor, once, p), b->shape->n_dof, q);
    }
    floor_lanes under = none, drift, shear;
    for (ptrdiff_t i = 0; line && i < b->shape->n_dof; i++) {
        const floor_lanes u = MOTION_AT(pass.next.u, i);
        floors_strain(&pass, i, &under, &u, &drift, &shear, ensemble_flags(&e->works->left, p));
        under = u;
    }
}

// A function for numbers that are held once, for those of each run, and for storeys on lines.
#define ENSEMBLE_BY(function, e, b, ...)                                                           \
    ((e)->line   ? function(e, b, false, (e)->line, __VA_ARGS__)                                   \
     : (b)->once ? function(e, b, true, NULL, __VA_ARGS__)                                         \
                 : function(e, b, false, NULL, __VA_ARGS__))

// The trial of a building and its residuals, and its end of the step with the account of the last
// one. Each stays a function: compilers mix up what is in others.
APART void ensemble_begin(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                          const wide *ground, ptrdiff_t trial) {
    ENSEMBLE_BY(ensemble_begin_by, e, b, p, ground, trial);
}

APART void ensemble_end(const struct ensemble_lanes *e, const struct ensemble_building *b, int p,
                        const wide *ground, ptrdiff_t trial) {
    ENSEMBLE_BY(ensemble_end_by, e, b, p, ground, trial);
}

// Adds the forces that live links begin the step with to the residuals, link by link as a run alone
// does.
LANES_INLINE void ensemble_push(const struct ensemble_lanes *e, int p) {
    double *residual = ensemble_part(&e->trial->residual, p);
    for (int k = 0; k < e->n_contact; k++) {
        if (e->acts[k]) {
            const floor_lanes force = FLOORS_AT(ensemble_part(e->force, p), k);
            MOTION_SET(residual, e->end[k][0]) -= force;
            MOTION_SET(residual, e->end[k][1]) += force;
        }
    }
}

// Computes `next` of part p. In free flight few buildings at a time go through the whole step, and
// use the same trials.
LANES_INLINE void ensemble_step(const struct ensemble_lanes *e, int p, const wide *ground,
                                bool in_flight) {
    const struct ensemble_building *b = e->building;
    const int together = in_flight ? TOGETHER : e->n_building;
    *ensemble_flags(&e->works->left, p) = (floor_bits){0};
    for (int first = 0; first < e->n_building; first += together) {
        const int last = first + together < e->n_building ? first + together : e->n_building;
        const int floor = b[first].shape->first;
        for (int k = first; k < last; k++) {
            ensemble_begin(e, &b[k], p, ground, b[k].shape->first - floor);
        }
        if (!in_flight) {
            ensemble_push(e, p);
        }
        for (int k = first; k < last; k++) {
            ensemble_end(e, &b[k], p, ground, b[k].shape->first - floor);
        }
    }
}

// Penetrations of contact k in `next`, and what it asks for: negative where it is closed, and where
// it is closed or nearer than ever.
LANES_INLINE void ensemble_near(const struct ensemble_lanes *e, int k, int p, floor_bits *closed,
                                floor_bits *nearer) {
    const double *u = ensemble_part(&e->next->u, p);
    struct ensemble_gap *c = &e->gap[k];
    const floor_lanes d = MOTION_AT(u, e->end[k][0]) - MOTION_AT(u, e->end[k][1]) -
                          FLOORS_AT(ensemble_part(&c->width, p), 0);
    *closed |= (floor_bits)(0.0 - d);
    *nearer |= (floor_bits)(FLOORS_AT(ensemble_part(&c->limit, p), 0) - d);
}

// The runs of part p in which flags are negative, a bit each.
LANES_INLINE unsigned ensemble_runs(int p, const floor_bits *flags) {
    unsigned runs = 0;
    for (int lane = 0; lane < FLOORS_VECTOR; lane++) {
        runs |= ((*flags)[lane] < 0 ? 1U : 0U) << (p * FLOORS_VECTOR + lane);
    }
    return runs;
}

FLOORS_CLONES static void ensemble_press(struct ensemble_lanes *e) {
    e->n_pressed = 0;
    for (int k = 0; k < e->n_contact; k++) {
        unsigned runs = 0, inside = 0;
        for (int p = 0; p < FLOORS_PARTS; p++) {
            floor_bits active, closed = {0}, nearer = {0};
            ensemble_part_active(e, p, &active);
            ensemble_near(e, k, p, &closed, &nearer);
            nearer &= active;
            if (floors_any(&nearer)) {
                runs |= ensemble_runs(p, &nearer);
                inside |= ensemble_runs(p, &closed);
            }
        }
        if (runs != 0) {
            e->pressed[e->n_pressed++] =
                (struct ensemble_pressed){k, runs & inside, runs & ~inside};
        }
    }
}

FLOORS_CLONES static int ensemble_march(struct ensemble_lanes *e, const wide *base, int n,
                                        long first) {
    for (int i = 0; i < n; i++) {
        floor_bits ends = {0}, nears = {0};
        for (int p = 0; p < FLOORS_PARTS; p++) {
            floor_bits active, closed = {0}, nearer = {0};
            ensemble_part_active(e, p, &active);
            ensemble_step(e, p, base + i, true);
            for (int k = 0; k < e->n_contact; k++) {
                ensemble_near(e, k, p, &closed, &nearer);
            }
            closed |= *ensemble_flags(&e->works->beyond, p) | *ensemble_flags(&e->works->left, p);
            ends |= closed & active;
            nears |= nearer & active;
        }
        e->owing = false;
        if (floors_any(&ends)) {
            return i;
        }
        const double time = (double)(first + i) * e->scheme.h;
        if (floors_any(&nears)) {
            ensemble_press(e);
            ensemble_approach(e, time);
        }
        ensemble_commit(e, base + i, time);
    }
    return n;
}

FLOORS_CLONES static void ensemble_move(struct ensemble_lanes *e, const wide *base) {
    for (int p = 0; p < FLOORS_PARTS; p++) {
        ensemble_step(e, p, base, false);
    }
    e->owing = false;
    for (int k = 0; k < e->n_contact; k++) {
        if (e->acts[k]) {
            e->force[k] = (wide){0.0};
            e->acts[k] = false;
        }
    }
}

FLOORS_CLONES static void ensemble_move_pushed(struct ensemble_lanes *e, const wide *base) {
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_building *b = &e->building[k];
        const ptrdiff_t first = b->shape->first;
        for (int p = 0; b->pushed && p < FLOORS_PARTS; p++) {
            const struct floors_pass pass = ensemble_pass(e, b, false, e->line, p, base, first);
            floors_finish(&pass, 0, b->shape->n_dof, ensemble_part(e->correction + first, p),
                          ensemble_flags(&e->works->left, p));
        }
        b->pushed = false;
    }
}

FLOORS_CLONES static void ensemble_catch_up(struct ensemble_lanes *e) {
    for (int k = 0; e->owing && k < e->n_building * FLOORS_PARTS; k++) {
        const struct ensemble_building *b = &e->building[k / FLOORS_PARTS];
        ENSEMBLE_BY(ensemble_account, e, b, k % FLOORS_PARTS);
    }
    e->owing = false;
}

const struct ensemble_steps STEPS = {
    .march = ensemble_march,
    .move = ensemble_move,
    .move_pushed = ensemble_move_pushed,
    .press = ensemble_press,
    .catch_up = ensemble_catch_up,
    .solves = FLOORS_PARTS == 1,
};

#endif
