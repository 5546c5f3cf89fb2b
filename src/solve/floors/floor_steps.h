// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of floors.h, on vectors of one width (floor_vectors.h), as a struct floors_steps called
// FLOORS_STEPS. Each block of buildings goes through the whole step, and through the account of the
// step before, ahead of the next block. Lanes do not begin where buildings do: what a block
// computes of its neighbour's floors, the neighbour computes again.
#ifndef JOSTLE_FLOOR_STEPS_H
#define JOSTLE_FLOOR_STEPS_H

#include "solve/floors/floor_step.h"
#include "solve/floors/floors_full.h"
#include "solve/newmark/newmark.h"
#include "solve/work.h"

// The floors of a block. Where they are few, `few` of them in all, these are constants.
struct span {
    ptrdiff_t first, n, end;
};

LANES_INLINE struct span floors_span(const struct floor_block *b, ptrdiff_t few) {
    return few > 0 ? (struct span){0, few, few} : (struct span){b->first, b->n, b->end};
}

LANES_INLINE struct floors_motion floors_motion_of(const struct state *s) {
    return (struct floors_motion){s->u, s->v, s->a, s->drift, s->shear, NULL};
}

// The step from `now` to `next`, and its numbers.
LANES_INLINE struct floors_pass floors_pass_of(const struct work *w, const struct state *now,
                                               const struct state *next, struct chain chain) {
    return (struct floors_pass){.chain = chain,
                                .now = floors_motion_of(now),
                                .next = floors_motion_of(next),
                                .ground = next->ground_a[0],
                                .h = w->h,
                                .half = w->h * w->h / 2.0,
                                .b = w->b,
                                .g = w->g,
                                .residual = w->floors.residual,
                                .u_trial = w->floors.u_trial,
                                .v_trial = w->floors.v_trial};
}

// The corrections q of a block, from its first floor on, by the inverses of buildings as long as
// they are low: all of few floors in flight are.
LANES_INLINE void floors_solve_block(const struct floors_pass *p, const struct work *w,
                                     const struct floor_block *b, const struct span *s,
                                     bool are_low, double *q) {
    struct effective *e = &w->effective[b->building], *end = e + b->n_building;
    const ptrdiff_t bottom = e->building->first - s->first;
    double *r = p->residual + bottom;
    q += bottom;
    for (; e < end && (are_low || effective_has_inverse(e)); e++) {
        const int n = e->building->n_dof;
        floors_multiply(e->inverse, n, false, r, q);
        r += n;
        q += n;
    }
    if (e < end) {
        effective_solve(e, (int)(end - e), r, q);
    }
}

// The bands of C. Of many floors, that of the floor above is read where that one has it, as C is
// symmetric: an array less.
LANES_INLINE struct chain floors_chain(const struct work *w, ptrdiff_t few) {
    struct chain c = w->model->chain;
    c.damping_above = few > 0 ? c.damping_above : c.damping_below + 1;
    return c;
}

// The step from s0 to s1, which began with ground acceleration ground_a0.
LANES_INLINE struct floors_taken floors_taken_of(const struct work *w, const struct state *s0,
                                                 const struct state *s1, double ground_a0,
                                                 bool yields, ptrdiff_t few) {
    const struct floors_account *to = &w->floors.account;
    return (struct floors_taken){
        .chain = floors_chain(w, few),
        .s0 = floors_motion_of(s0),
        .s1 = floors_motion_of(s1),
        .ground = s1->ground_a[0],
        .ground_2x = ground_a0 + s1->ground_a[0],
        .time = s1->time,
        .input_2x = to->energy->input_2x,
        .damping_2x = to->energy->damping_2x,
        .storey_2x = to->energy->storey_2x,
        .peak = to->results->peak,
        .peak_time = to->results->peak_time,
        .yields = yields,
    };
}

// The account that is due, which is taken from floor `done` on.
struct due {
    struct floors_taken step;
    ptrdiff_t done, n;
};

LANES_INLINE struct due floors_due(const struct work *w, const struct state *old,
                                   const struct state *now, ptrdiff_t few, bool yields) {
    const struct floors_account *a = &w->floors.account;
    const ptrdiff_t n = few > 0 ? few : w->model->chain.n;
    return (struct due){floors_taken_of(w, old, now, a->ground_a, yields, few), a->due ? 0 : n, n};
}

// Takes the floors from `first` to `end` into works and peaks.
LANES_INLINE void floors_account_part(const struct floors_taken *step, ptrdiff_t first,
                                      ptrdiff_t end) {
    floor_lanes input[FLOORS_VECTORS], damping[FLOORS_VECTORS];
    EACH_OF_LANES(j) {
        input[j] = FLOORS_AT(step->input_2x, j * FLOORS_VECTOR);
        damping[j] = FLOORS_AT(step->damping_2x, j * FLOORS_VECTOR);
    }
    floors_take(step, first, end, (double *)input, (double *)damping);
    EACH_OF_LANES(j) {
        FLOORS_SET(step->input_2x, j * FLOORS_VECTOR) = input[j];
        FLOORS_SET(step->damping_2x, j * FLOORS_VECTOR) = damping[j];
    }
}

// Takes the account that is due as far as floor `end`, if there are so many.
LANES_INLINE void floors_account_upto(struct due *d, ptrdiff_t end) {
    end = end < d->n ? end : d->n;
    if (d->done < end) {
        floors_account_part(&d->step, d->done, end);
        d->done = end;
    }
}

// Floors that there are not, in the last lanes, stay 0: corrections there are those of other
// blocks.
LANES_INLINE void floors_clear_beyond(const struct model *m, const struct state *next) {
    for (ptrdiff_t i = m->n_dof; i < m->chain.n; i++) {
        next->u[i] = next->v[i] = next->a[i] = 0.0;
    }
}

// The next block finishes the floors that this one leaves over.
LANES_INLINE void floors_hand_over(const struct floor_block *b, double *q) {
    *(lanes_wide *)q = LANES_AT(q, b->end - b->first);
}

// Penetrations of a vector of contacts of a run, from number i on.
LANES_INLINE void floors_delta(const struct gaps *g, const struct gap_run *r, ptrdiff_t i,
                               const double *u, const double *ground, floor_lanes *delta) {
    const int left = r->ground[0], right = r->ground[1];
    *delta = FLOORS_AT(u + r->left, i) - FLOORS_AT(u + r->right, i) - FLOORS_AT(g->gap + r->gap, i);
    if (left != right) {
        *delta += ground[left] - ground[right];
    }
}

// What contacts of a state in flight ask for, where negative.
struct floors_approach {
    floor_bits closed, nearer;  // closed, and closed or nearer than ever
};

// That of some runs of contacts.
LANES_INLINE void floors_approach(const struct gaps *g, int from, int to, const double *u,
                                  const double *ground, struct floors_approach *near) {
    for (const struct gap_run *r = g->run + from; r < g->run + to; r++) {
        for (ptrdiff_t first = 0; first < r->n; first += LANES_WIDTH) {
            EACH_OF_LANES(j) {
                const ptrdiff_t i = first + j * FLOORS_VECTOR;
                floor_lanes d;
                floors_delta(g, r, i, u, ground, &d);
                near->closed |= (floor_bits)(0.0 - d);
                near->nearer |= (floor_bits)(FLOORS_AT(g->limit + r->first, i) - d);
            }
        }
    }
}

// Notes the penetrations of `s` that are larger than ever, in runs below `end`.
LANES_INLINE void floors_note(struct gaps *g, int end, const struct state *s) {
    for (const struct gap_run *r = g->run; r < g->run + end; r++) {
        for (int i = 0; i < r->n; i += FLOORS_VECTOR) {
            floor_lanes d;
            floors_delta(g, r, i, s->u, s->ground_u, &d);
            const floor_bits larger = (floor_bits)(FLOORS_AT(g->nearest + r->first, i) - d);
            for (int k = 0; floors_any(&larger) && k < FLOORS_VECTOR && i + k < r->n; k++) {
                gaps_note(g, r->first + i + k, d[k], s->time);
            }
        }
    }
}

// Takes a step from `now` to `next` in one block after the other, each with the account that is due
// of the floors that see what it overwrites. `f` NULL: the floors feel the forces of live links.
// Else the step goes as far as it is known to be one in free flight. False: a number is not finite,
// or it is no such step.
LANES_INLINE bool floors_step(struct work *w, const struct flight *f,
                              const struct floors_lines *lines, const struct state *now,
                              struct state *next, ptrdiff_t few) {
    struct floors_pass pass = floors_pass_of(w, now, next, floors_chain(w, few));
    pass.lines = *lines;
    const double *external = few > 0 || state_is_uniform(w->model) ? NULL : next->external;
    struct due account = floors_due(w, next, now, few, lines->back != NULL);
    struct floors_approach near = {{0}, {0}};
    floor_bits ends = {0};
    if (w->model->chain.full_damping && w->floors.account.due) {
        floors_full_work(w, next, now);
    }
    for (int i = 0, run = 0; i < (few > 0 ? 1 : w->floors.n_block); i++) {
        const struct floor_block *b = &w->floors.block[i];
        const struct span s = floors_span(b, few);
        double *q = f && f->n_link == 0 ? w->floors.correction : w->correction + s.first;
        floors_begin(&pass, s.first, s.n, external, &ends);
        if (!f && next->n_live > 0) {
            floors_push(w, now, next, b);
        }
        if (w->model->chain.full_damping) {
            floors_full_forces(w, b, lines->given == NULL);
        }
        floors_solve_block(&pass, w, b, &s, f && few > 0, q);
        if (f && f->n_link > 0) {
            flight_join(f, now, next);
        }
        floors_account_upto(&account, s.end + LANES_WIDTH);
        floors_finish(&pass, s.first, s.end, q, &ends);
        if (f && few == 0) {
            floors_hand_over(b, q);
        }
        if (f) {
            floors_approach(&w->gaps, run, f->run_end[i], pass.next.u, next->ground_u, &near);
            ends |= near.closed;
            run = f->run_end[i];
        }
        if (f && floors_any(&ends)) {
            break;
        }
    }
    floors_account_upto(&account, account.n);
    w->floors.account.due = false;
    if (few == 0) {
        floors_clear_beyond(w->model, next);
    }
    const bool taken = !floors_any(&ends);
    if (f && taken && floors_any(&near.nearer)) {
        floors_note(&w->gaps, f->run_end[w->floors.n_block - 1], next);
    }
    return taken;
}

// Sets the time of `s`, the end of step n, and what acts on the floors then.
LANES_INLINE void floors_excite(const struct flight *f, struct state *s, long n, bool is_uniform) {
    struct forcing_ahead *x = &f->work->ahead;
    if (n < x->from || n >= x->from + FORCING_AHEAD) {
        forcing_foresee(x, f->model, n);
    }
    s->time = x->time[n - x->from];
    if (is_uniform) {
        s->ground_a[0] = x->ground[n - x->from];
    } else {
        forcing_at(s, f->model, s->time);
    }
}

LANES_INLINE long floors_fly_from(const struct flight *f, const struct floors_lines *lines,
                                  struct state **now, struct state **next, long n, long end,
                                  ptrdiff_t few) {
    for (; n < end; n++) {
        struct state *from = *now, *to = *next;
        floors_excite(f, to, n + 1, few > 0 || f->uniform);
        if (!floors_step(f->work, f, lines, from, to, few)) {
            break;
        }
        if (f->model->chain.full_damping) {
            floors_full_strain(f->work, to);
        }
        if (few > 0 || f->account->defers) {
            floors_defer(&f->work->floors.account, from);
        } else {
            floors_account(f->work, from, to);
        }
        if (f->n_link > 0) {
            flight_account_links(f, from, to);
        }
        if (f->work->floors.account.forces) {
            force_peaks_note(f->work->floors.account.forces, to);
        }
        *now = to;
        *next = from;
    }
    return n;
}

// The number of floors in whole lanes, where they are few and one ground moves them all; else 0.
LANES_INLINE ptrdiff_t floors_few(const struct model *m) {
    return state_is_uniform(m) && m->chain.n <= 2L * LANES_WIDTH ? m->chain.n : 0;
}

// A function for each number of few floors, which is a constant there, and for all others.
#define FLOORS_BY_FEW(m, function, ...)                                                            \
    (floors_few(m) == LANES_WIDTH        ? function(__VA_ARGS__, LANES_WIDTH)                      \
     : floors_few(m) == 2L * LANES_WIDTH ? function(__VA_ARGS__, 2L * LANES_WIDTH)                 \
                                         : function(__VA_ARGS__, 0))

static const struct floors_lines elastic = {0};

FLOORS_CLONES static long floor_steps_fly(const struct flight *f, struct state **now,
                                          struct state **next, long n, long end) {
    const struct floors_lines lines = {f->back, f->spring, f->rest, f->limit, NULL};
    return f->on_lines ? FLOORS_BY_FEW(f->model, floors_fly_from, f, &lines, now, next, n, end)
                       : FLOORS_BY_FEW(f->model, floors_fly_from, f, &elastic, now, next, n, end);
}

FLOORS_CLONES static bool floor_steps_move(struct work *w, const struct state *now,
                                           struct state *next, const double *shear) {
    const struct floors_lines lines = {.given = shear};
    return shear ? FLOORS_BY_FEW(w->model, floors_step, w, NULL, &lines, now, next)
                 : FLOORS_BY_FEW(w->model, floors_step, w, NULL, &elastic, now, next);
}

FLOORS_CLONES static void floor_steps_correct(struct work *w, const struct state *now,
                                              struct state *next) {
    struct floors_pass pass = floors_pass_of(w, now, next, w->model->chain);
    floor_bits beyond = {0};
    for (int i = 0; i < w->gaps.n_touched; i++) {
        const struct building *g = &w->model->building[w->gaps.touched[i]];
        const ptrdiff_t first = g->first;
        pass.u_trial = w->u_trial + first;
        pass.v_trial = w->v_trial + first;
        floors_finish(&pass, first, first + lanes_whole(g->n_dof), w->correction + first, &beyond);
    }
}

FLOORS_CLONES static void floor_steps_account(const struct work *w, const struct state *s0,
                                              const struct state *s1, double ground_a0) {
    const struct model *m = w->model;
    struct floors_taken step = floors_taken_of(w, s0, s1, ground_a0, !state_is_linear(m), 0);
    if (!state_is_uniform(m)) {
        step.base = s1->base;
        step.s0.external = s0->external;
        step.s1.external = s1->external;
    }
    if (m->chain.full_damping) {
        floors_full_work(w, s0, s1);
    }
    floors_account_part(&step, 0, step.chain.n);
}

const struct floors_steps FLOORS_STEPS = {
    .move = floor_steps_move,
    .fly = floor_steps_fly,
    .correct = floor_steps_correct,
    .account = floor_steps_account,
};

#endif
