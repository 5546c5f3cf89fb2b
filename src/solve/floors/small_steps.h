// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of small_model.h, for vectors of one width (floor_vectors.h), as a struct small_steps
// called SMALL_STEPS. In free flight everything stays in registers from step to step but for the
// displacements, which the penetrations need in memory.
#ifndef JOSTLE_SMALL_STEPS_H
#define JOSTLE_SMALL_STEPS_H

#include "solve/account/peaks.h"
#include "solve/floors/small_loops.h"

// Penetrations at the displacements u, into `delta` if that is not NULL; *sign gets negative where
// a contact closes or is nearer than ever.
LANES_INLINE void small_look(const struct flight *f, const double *u, double *delta,
                             floor_bits *sign) {
    const double *gap = f->gap;
    for (const struct gap_group *g = f->group; g < f->group + f->n_group; g++) {
        const double *left = u + g->dof[0], *right = u + g->dof[1];
        const double *limit = f->work->gaps.limit + g->contact;
        EACH_VECTOR(i, FLOORS_VECTORS) {
            floor_lanes d = PART(left, i) - PART(right, i) - PART(gap, i);
            *sign |= (floor_bits)(PART(limit, i) - d);
            if (delta) {
                *(floor_lanes *)(delta + g->contact + i * FLOORS_VECTOR) = d;
            }
        }
        gap += LANES_WIDTH;
    }
}

LANES_INLINE void small_add_storey_works(int n, const struct small_floors *now,
                                         const struct small_floors *next, double *work) {
    EACH_VECTOR(j, n) {
        *(floor_lanes *)(work + j * FLOORS_VECTOR) +=
            (now->shear[j] + next->shear[j]) * (next->drift[j] - now->drift[j]);
    }
}

LANES_INLINE void small_get(double *x, const double *from, int n) {
    EACH_VECTOR(j, n) {
        *(floor_lanes *)(x + j * FLOORS_VECTOR) = PART(from, j);
    }
}

LANES_INLINE void small_get_peaks(struct small_table *t, const struct results *r, int n) {
    for (int q = 0; q < PEAK_COUNT; q++) {
        small_get(t->peak[q], r->peak[q], n);
    }
}

LANES_INLINE void small_get_lines(struct small_table *t, const struct floors_lines *lines, int n) {
    small_get(t->back, lines->back, n);
    small_get(t->spring, lines->spring, n);
    small_get(t->rest, lines->rest, n);
    small_get(t->limit, lines->limit, n);
}

LANES_INLINE double small_ground(const struct work *w, long step) {
    return w->ahead.ground[step - w->ahead.from];
}

// A flight of a model of n vectors. `lines` NULL: all storeys are elastic.
struct small_flight {
    const struct flight *flight;
    const struct floors_lines *lines;
    int n;
    struct state *state;  // of the step that it began with
    const double *u;      // displacements at the end of the step in hand, in memory for the gaps
};

// Takes the step to `next` into the peaks. False: it is not in free flight.
LANES_INLINE bool small_take_note(const struct small_flight *c, const struct small_floors *next,
                                  double time, double ground) {
    const struct flight *f = c->flight;
    enum nearness near = small_nearness(f, c->u, c->state->ground_u);
    if (near == NEARNESS_CLOSED || !small_raise(f->account->results, c->n, next, time, ground)) {
        return false;
    }
    small_get_peaks(f->work->small.table, f->account->results, c->n);
    if (near == NEARNESS_DEEPEST) {
        small_store(next, c->lines, c->n, c->state);
        c->state->time = time;
        flight_deepen(f, c->state);
    }
    return true;
}

// Is step `step`, to `next`, one in free flight? Then it is taken into the peaks. *end becomes that
// step if `ahead`, of the trial from there, is negative.
LANES_INLINE bool small_confirm(const struct small_flight *c, struct small_table *t,
                                struct small_floors *next, double ground, const floor_bits *ahead,
                                long step, long *end) {
    const struct work *w = c->flight->work;
    double *const peak[PEAK_COUNT] = {t->peak[0], t->peak[1], t->peak[2], t->peak[3], t->peak[4]};
    floor_bits beyond = {0}, news = *ahead;
    small_strain(t, c->lines, c->n, next, &beyond);
    small_compare(peak, c->lines, c->n, next, ground, &news);
    small_look(c->flight, c->u, NULL, &news);
    news |= beyond;
    if (!floors_any(&news)) {
        return true;
    }
    *end = floors_any(ahead) ? step : *end;
    return !floors_any(&beyond) &&
           small_take_note(c, next, w->ahead.time[step - w->ahead.from], ground);
}

// The works of the step from `before` to `now`.
LANES_INLINE void small_work(const struct small_flight *c, const struct small_table *t,
                             const struct small_floors *before, const struct small_floors *now,
                             double ground_2x, struct floors_works *works) {
    small_add_works(t, c->n, before, now, ground_2x, works);
    if (c->lines) {
        small_add_storey_works(c->n, before, now, c->flight->account->energy->storey_2x);
    }
}

// Takes steps of a model of n vectors from number `from` to number `end`, or until one is not in
// free flight; returns the one reached. From one trial to the next each operation waits for the one
// before, and meanwhile the processor does independent ones that stand near: so a step is checked
// after the next trial has begun, and its works are added one step later.
LANES_INLINE long small_fly(const struct flight *f, const struct floors_lines *lines, int n,
                            struct state *s, long from, long end) {
    const struct work *w = f->work;
    // Volatile, so that each step reads its numbers from the table as operands; otherwise the
    // compiler carries as many as it can from step to step, most of them on the stack.
    struct small_table *volatile table = w->small.table;
    const struct small_scheme scheme = small_scheme_of(w);
    alignas(LANES_LINE) double shown[SMALL_MAX + 2 * LANES_WIDTH] = {0.0};
    const struct small_flight c = {f, lines, n, s, shown};
    alignas(LANES_LINE) double residual[SMALL_MAX];
    struct small_floors before, now, trial;
    struct floors_works works;
    double ground = s->ground_a[0], then = small_ground(w, from + 1), ground_2x = 0.0;
    floor_bits beyond = {0};
    small_load(s, lines, n, &now);
    floors_load_works(f->account->energy, &works);
    small_get_peaks(table, f->account->results, n);
    if (lines) {
        small_get_lines(table, lines, n);
    }
    before = now;
    small_try(table, &scheme, lines, n, &now, then, &trial, residual, &beyond);
    end = floors_any(&beyond) ? from : end;
    long step = from;
    while (step < end) {
        struct small_table *t = table;
        struct small_floors next, ahead;
        floor_lanes q[VECTORS];
        const double later = small_ground(w, step + 2 < end ? step + 2 : end);
        small_solve(&w->small, n, residual, q);
        small_work(&c, t, &before, &now, ground_2x, &works);
        before = now;
        small_reach(&scheme, n, &now, &trial, q, &next);
        small_put(next.u, n, shown);
        beyond = (floor_bits){0};
        small_try(t, &scheme, lines, n, &next, later, &ahead, residual, &beyond);
        if (!small_confirm(&c, t, &next, then, &beyond, step + 1, &end)) {
            break;
        }
        ground_2x = ground + then;
        now = next;
        trial = ahead;
        ground = then;
        then = later;
        step++;
    }
    small_work(&c, table, &before, &now, ground_2x, &works);
    small_store(&now, lines, n, s);
    floors_store_works(&works, f->account->energy);
    if (step > from) {
        s->time = w->ahead.time[step - w->ahead.from];
        s->ground_a[0] = w->ahead.ground[step - w->ahead.from];
    }
    return step;
}

FLOORS_CLONES static long fly(const struct flight *f, struct state *s, long n, long end) {
    return is_low(f->model) ? small_fly(f, NULL, VECTORS / 2, s, n, end)
                            : small_fly(f, NULL, VECTORS, s, n, end);
}

FLOORS_CLONES static long fly_on_lines(const struct flight *f, struct state *s, long n, long end) {
    const struct floors_lines lines = floors_lines_of(f, s);
    return is_low(f->model) ? small_fly(f, &lines, VECTORS / 2, s, n, end)
                            : small_fly(f, &lines, VECTORS, s, n, end);
}

// What is new in a step to `next`, the floors of which are not finite where *infinite is negative.
LANES_INLINE enum small_news small_see(const struct work *w, struct state *next,
                                       const floor_bits *infinite) {
    floor_bits news = *infinite;
    if (w->small.flight) {
        small_look(w->small.flight, next->u, next->delta, &news);
        if (!floors_any(&news)) {
            return SMALL_NOTHING;
        }
    }
    return floors_any(infinite) ? SMALL_INFINITE : SMALL_NEAR;
}

LANES_INLINE enum small_news move(struct work *w, const struct state *now, struct state *next,
                                  int n) {
    alignas(LANES_LINE) double residual[SMALL_MAX];
    struct small_floors start, trial, end;
    floor_lanes q[VECTORS];
    floor_bits sign = {0};
    const struct small_scheme scheme = small_scheme_of(w);
    small_load(now, NULL, n, &start);
    const double ground = next->ground_a[0];
    small_try(w->small.table, &scheme, NULL, n, &start, ground, &trial, residual, &sign);
    state_add_link_forces(next, w->model, residual);
    small_solve(&w->small, n, residual, q);
    small_reach(&scheme, n, &start, &trial, q, &end);
    small_put(trial.u, n, w->u_trial);
    small_put(trial.v, n, w->v_trial);
    small_put(q, n, w->correction);
    small_store(&end, NULL, n, next);
    small_weigh(n, &end, &sign);
    return small_see(w, next, &sign);
}

FLOORS_CLONES static enum small_news take_step(struct work *w, const struct state *now,
                                               struct state *next) {
    return is_low(w->model) ? move(w, now, next, VECTORS / 2) : move(w, now, next, VECTORS);
}

LANES_INLINE enum small_news correct(const struct work *w, const struct state *now,
                                     struct state *next, int n) {
    const struct small_scheme scheme = small_scheme_of(w);
    struct small_floors start, trial, end;
    floor_lanes q[VECTORS];
    const floor_bits sign = {0};
    EACH_VECTOR(j, n) {
        start.a[j] = PART(now->a, j);
        trial.u[j] = PART(w->u_trial, j);
        trial.v[j] = PART(w->v_trial, j);
        q[j] = PART(w->correction, j);
    }
    small_reach(&scheme, n, &start, &trial, q, &end);
    small_store(&end, NULL, n, next);
    return small_see(w, next, &sign);
}

FLOORS_CLONES static enum small_news take_corrections(const struct work *w, const struct state *now,
                                                      struct state *next) {
    return is_low(w->model) ? correct(w, now, next, VECTORS / 2) : correct(w, now, next, VECTORS);
}

LANES_INLINE void account(const struct work *w, const struct state *now, const struct state *next,
                          int n) {
    const struct small_table *t = w->small.table;
    struct energy_account *a = w->floors.account.energy;
    struct results *r = w->floors.account.results;
    struct small_floors start, end;
    struct floors_works works;
    floor_bits sign = {0};
    small_load(now, NULL, n, &start);
    small_load(next, NULL, n, &end);
    small_strain(t, NULL, n, &end, &sign);
    floors_load_works(a, &works);
    const double ground = next->ground_a[0], ground_2x = ground + now->ground_a[0];
    small_add_works(t, n, &start, &end, ground_2x, &works);
    floors_store_works(&works, a);
    small_compare(r->peak, NULL, n, &end, ground, &sign);
    if (floors_any(&sign)) {
        (void)small_raise(r, n, &end, next->time, ground);
        peaks_speed(r, 0, n * FLOORS_VECTOR);
    }
}

FLOORS_CLONES static void take_account(const struct work *w, const struct state *now,
                                       const struct state *next) {
    is_low(w->model) ? account(w, now, next, VECTORS / 2) : account(w, now, next, VECTORS);
}

const struct small_steps SMALL_STEPS = {
    .fly = fly,
    .fly_on_lines = fly_on_lines,
    .move = take_step,
    .correct = take_corrections,
    .account = take_account,
};

#endif
