// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of floors.h, on vectors of one width (floor_vectors.h), as a struct floors_steps called
// FLOORS_STEPS.
//     u_t = u + h v + h^2 a / 2,   v_t = v + h a,
//     A q = -M a_ground + p - M a - C v_t - K u_t - B' f,
//     u = u_t + beta h^2 q,   v = v_t + gamma h q,   a = a + q,
// with the works of the step before and the tests for peaks. Each block of buildings goes through
// all of this before the next one. Lanes do not begin where buildings do: what a block computes of
// its neighbour's floors, the neighbour computes again.
#ifndef JOSTLE_FLOOR_STEPS_H
#define JOSTLE_FLOOR_STEPS_H

#include "solve/contact/contact.h"
#include "solve/floors/effective_low.h"
#include "solve/floors/floor_account.h"

// effective_solve_row, in line as long as buildings are low.
LANES_INLINE void solve_row(struct effective *e, int n, double *r, double *q) {
    int k = 0;
    for (; k < n && effective_is_low(&e[k]); k++) {
        effective_multiply(&e[k], r, q);
        r += e[k].building->n_floor;
        q += e[k].building->n_floor;
    }
    if (k < n) {
        effective_solve_row(&e[k], n - k, r, q);
    }
}

// A step under way.
struct move {
    struct work *work;
    const struct state *now;
    const struct state *next;
    struct chain chain;
    struct floors_motion from, to;
    struct floors_scratch scratch;
};

LANES_INLINE struct move move_of(struct work *w, const struct state *now,
                                 const struct state *next) {
    return (struct move){.work = w,
                         .now = now,
                         .next = next,
                         .chain = w->model->chain,
                         .from = floors_motion(now),
                         .to = floors_motion(next),
                         .scratch = {w->floors.residual, w->floors.u_trial, w->floors.v_trial}};
}

// The next state of a block, and its corrections q from its first floor on. `lines` NULL: all
// storeys are elastic. True if a storey is beyond its line, or what is found is not finite.
LANES_INLINE bool move_block(const struct move *s, const struct floors_lines *lines,
                             const struct floor_block *b, double *q) {
    struct work *w = s->work;
    const struct floors_correction correction = {q, w->b, w->g};
    const double *external = state_is_uniform(w->model) ? NULL : s->next->external;
    int bottom = w->model->building[b->building].first - b->first;
    bool beyond = floors_unbalance(&s->chain, lines, w->h, b->first, b->n, &s->from,
                                   s->next->ground_a[0], external, &s->scratch);
    if (s->next->n_live > 0) {
        floors_push(w, s->now, s->next, b);
    }
    solve_row(&w->effective[b->building], b->n_building, s->scratch.residual + bottom, q + bottom);
    beyond |= floors_reach(&correction, b->first, b->end, &s->scratch, s->from.a, &s->to);
    return beyond;
}

// The account of a step from s0 to s1 under one ground, taken from floor `done` on.
struct account {
    const struct chain *chain;
    struct energy_account *energy;
    const struct results *results;
    struct floors_moment s0, s1;
    int done;
};

// Takes it as far as floor `end`.
LANES_INLINE void account_to(struct account *a, int end) {
    const int first = a->done;
    if (first >= end) {
        return;
    }
    const struct chain c = *a->chain;
    const struct floors_moment s0 = a->s0, s1 = a->s1;
    const struct floors_peaks p = {a->results->peak, a->results->peak_time};
    floors_add(&c, first, end, &s0, &s1, &p, a->energy);
    if (s0.shear) {
        floors_add_shears(first, end, &s0, &s1, &p);
    }
    a->done = end;
}

// What is due of the step from `old` to `now`.
LANES_INLINE struct account account_due(const struct work *w, const struct state *old,
                                        const struct state *now) {
    const struct floors_account *to = &w->floors.account;
    const struct model *m = w->model;
    struct account a = {&m->chain,
                        to->energy,
                        to->results,
                        floors_moment_of(m, old),
                        floors_moment_of(m, now),
                        to->due ? 0 : m->chain.n};
    a.s0.time = to->time;
    a.s0.ground = to->ground_a;
    return a;
}

// Takes what is due as far as the floors that see what the next block overwrites.
LANES_INLINE void account_ahead(struct account *a, const struct floor_block *next) {
    account_to(a, next->end + LANES_WIDTH < a->chain->n ? next->end + LANES_WIDTH : a->chain->n);
}

// Takes a state into the peaks.
FLOORS_CLONES static void raise(struct results *r, const struct model *m, const struct state *now) {
    const struct chain c = m->chain;
    const struct floors_moment s = floors_moment_of(m, now);
    const struct floors_peaks p = {r->peak, r->peak_time};
    const lanes_wide_bits each = ~(lanes_wide_bits){0};
    const struct floors_asked all = {each, each, each, each};
    for (int i = 0; i < c.n; i += LANES_WIDTH) {
        floors_raise_motion(&p, &s, i, &all);
        floors_raise_drifts(&p, &c, &s, i, &all);
    }
}

FLOORS_CLONES static void catch_up(struct work *w, const struct state *old,
                                   const struct state *now) {
    struct account due = account_due(w, old, now);
    account_to(&due, w->model->chain.n);
    w->floors.account.due = false;
    raise(w->floors.account.results, w->model, now);
}

FLOORS_CLONES static bool move(struct work *w, const struct state *now, struct state *next) {
    const struct move move = move_of(w, now, next);
    struct account due = account_due(w, next, now);
    bool beyond = false;
    for (int i = 0; i < w->floors.n_block; i++) {
        const struct floor_block *b = &w->floors.block[i];
        account_ahead(&due, b);
        beyond |= move_block(&move, NULL, b, w->correction + b->first);
    }
    w->floors.account.due = false;
    return !beyond;
}

// The next block finishes the floors that this one leaves over.
LANES_INLINE void hand_over(const struct floor_block *b, double *q) {
    *(lanes_wide *)q = LANES_AT(q, b->end - b->first);
}

// A step as far as it is known to be one in free flight. `lines` NULL: all storeys are elastic.
LANES_INLINE bool fly(const struct flight *f, const struct floors_lines *lines,
                      const struct state *now, struct state *next) {
    struct work *w = f->work;
    const struct move move = move_of(w, now, next);
    struct account due = account_due(w, next, now);
    bool free = true;
    floor_bits beyond = {0};
    for (int i = 0, group = 0; i < w->floors.n_block && free; i++) {
        const struct floor_block *b = &w->floors.block[i];
        account_ahead(&due, b);
        bool ends = move_block(&move, lines, b, w->floors.correction);
        hand_over(b, w->floors.correction);
        if (lines) {
            floors_follow(&move.chain, lines, b->first, b->end, next->u, &beyond);
        }
        ends |= floors_any(&beyond);
        ends |= floors_approach(f, group, f->group_end[i], now, next);
        group = f->group_end[i];
        free = !ends;
    }
    account_to(&due, move.chain.n);
    w->floors.account.due = false;
    return free;
}

FLOORS_CLONES static bool fly_elastic(const struct flight *f, const struct state *now,
                                      struct state *next) {
    return fly(f, NULL, now, next);
}

FLOORS_CLONES static bool fly_on_lines(const struct flight *f, const struct state *now,
                                       struct state *next) {
    const struct floors_lines lines = floors_lines_of(f, next);
    return fly(f, &lines, now, next);
}

const struct floors_steps FLOORS_STEPS = {
    .move = move,
    .fly = fly_elastic,
    .fly_on_lines = fly_on_lines,
    .catch_up = catch_up,
    .raise = raise,
};

#endif
