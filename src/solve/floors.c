// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method, where all is linear but for the links, whose forces f are given:
//     u_t = u + h v + h^2 a / 2,   v_t = v + h a,
//     A q = -M a_ground + p - M a - C v_t - K u_t - B' f,
//     u = u_t + beta h^2 q,   v = v_t + gamma h q,   a = a + q,
// and the works of the step before and the tests for peaks. A block of buildings goes through all
// of it before the next one does. Lanes do not begin where buildings do: what a block computes of a
// neighbour's floors is computed by that one anew.
#include "solve/floors.h"

#include <string.h>

#include "core/arena.h"
#include "solve/contact.h"
#include "solve/floor_loops.h"

// So many floors make a block, and what is solved together.
enum { FLOORS_LEAST = 192 };

// Buildings from k on that make up a block.
static int block_size(const struct model *m, int k) {
    int n = 0;
    int floors = 0;
    while (k + n < m->n_building && floors < FLOORS_LEAST) {
        const struct building *b = &m->building[k + n];
        int alike = effective_alike(b, m->n_building - k - n);
        floors += alike * b->n_floor;
        n += alike;
    }
    return n;
}

static struct floor_block block_from(const struct model *m, int k, int first) {
    struct floor_block b = {.building = k, .n_building = block_size(m, k), .first = first};
    const struct building *last = &m->building[k + b.n_building - 1];
    int end = last->first + last->n_floor;
    b.n = lanes_whole(end) - first;
    b.end = k + b.n_building < m->n_building ? end / LANES_WIDTH * LANES_WIDTH : lanes_whole(end);
    return b;
}

bool floors_alloc(struct floors *f, const struct model *m, struct arena *a) {
    int most = 0;
    *f = (struct floors){
        .block = arena_alloc(a, (size_t)m->n_building, sizeof *f->block),
        .first_end = arena_alloc(a, (size_t)m->n_building, sizeof *f->first_end),
        .following_end = arena_alloc(a, 2 * (size_t)m->n_link, sizeof *f->following_end),
    };
    if (!f->block || !f->first_end || !f->following_end) {
        return false;
    }
    for (int k = 0, first = 0; k < m->n_building; f->n_block++) {
        struct floor_block b = block_from(m, k, first);
        f->block[f->n_block] = b;
        most = b.n > most ? b.n : most;
        first = b.end;
        k += b.n_building;
    }
    for (int k = 0; k < m->n_building; k++) {
        f->first_end[k] = -1;
    }
    f->residual = lanes_array(a, most + 2 * LANES_WIDTH);
    return f->residual != NULL;
}

// Lists the ends of live links by building, in the order of the links.
static void list_ends(struct floors *f, const struct gaps *gaps, const struct state *s) {
    for (int i = s->n_live - 1; i >= 0; i--) {
        const struct gap_run *run = &gaps->run[gaps->run_of[s->live[i]]];
        for (int side = 1; side >= 0; side--) {
            int end = 2 * s->live[i] + side;
            int k = run->building[side];
            if (k != WALL) {
                f->following_end[end] = f->first_end[k];
                f->first_end[k] = end;
            }
        }
    }
}

// Takes the forces of live links into the residual of a block, and the trial of their buildings for
// the contact iteration. The lists are used up.
static void push(struct work *w, const struct state *now, const struct state *next,
                 const struct floor_block *b) {
    const struct model *m = w->model;
    struct floors *f = &w->floors;
    for (int k = b->building; k < b->building + b->n_building; k++) {
        if (f->first_end[k] >= 0) {
            floors_trial(w, now, k);
        }
        for (int end = f->first_end[k]; end >= 0; end = f->following_end[end]) {
            double force = next->link[end / 2].force;
            f->residual[m->link[end / 2].dof[end % 2] - b->first] += end % 2 == 0 ? -force : force;
        }
        f->first_end[k] = -1;
    }
}

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
    struct floors_of from, to;
    struct floors_correction correction;
};

LANES_INLINE struct move move_of(struct work *w, const struct state *now,
                                 const struct state *next) {
    return (struct move){.work = w,
                         .now = now,
                         .next = next,
                         .chain = w->model->chain,
                         .from = floors_of(now),
                         .to = floors_of(next),
                         .correction = {w->correction, w->b, w->g, w->h}};
}

// The next state of a block. `lines` NULL: all storeys are elastic. Negative if a storey is beyond
// its line, or what is found is not finite.
LANES_INLINE int64_t move_block(const struct move *s, const struct floors_lines *lines,
                                const struct floor_block *b) {
    struct work *w = s->work;
    const double *external = state_is_uniform(w->model) ? NULL : s->next->external;
    int first = w->model->building[b->building].first;
    double *r = w->floors.residual;
    int64_t sign = floors_unbalance(&s->chain, lines, w->h, b->first, b->n, &s->from,
                                    s->next->ground_a[0], external, r);
    if (s->next->n_live > 0) {
        push(w, s->now, s->next, b);
    }
    solve_row(&w->effective[b->building], b->n_building, r + (first - b->first),
              w->correction + first);
    return sign | floors_correct(&s->correction, b->first, b->end, &s->from, &s->to);
}

void floors_trial(struct work *w, const struct state *now, int k) {
    const struct building *g = &w->model->building[k];
    const struct chain part = {.n = lanes_whole(g->n_floor)};
    const int i = g->first;
    chain_trial(&part, w->h, now->u + i, now->v + i, now->a + i, w->u_trial + i, w->v_trial + i);
}

// Takes a state into the peaks.
LANES static void raise(const struct chain *chain, const struct results *r,
                        const struct floors_moment *s) {
    const struct chain c = *chain;
    const struct floors_peaks p = {r->peak, r->peak_time};
    for (int i = 0; i < c.n; i += LANES_WIDTH) {
        floors_raise_motion(&p, s, i);
        floors_raise_drifts(&p, &c, s, i);
    }
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
    floors_add_peaks(first, end, &s0, &s1, &p);
    floors_add_works(&c, first, end, &s0, &s1, &p, a->energy);
    if (s0.shear) {
        floors_add_shears(first, end, &s0, &s1, &p);
    }
    a->done = end;
}

// What is due of the step from `old` to `now`.
LANES_INLINE struct account account_due(const struct floors_late *late, const struct model *m,
                                        const struct state *old, const struct state *now) {
    struct account a = {&m->chain,
                        late->energy,
                        late->results,
                        floors_moment_of(m, old),
                        floors_moment_of(m, now),
                        late->due ? 0 : m->chain.n};
    a.s0.time = late->time;
    a.s0.ground = late->ground_a;
    return a;
}

// Takes what is due as far as the floors that see what the next block overwrites.
LANES_INLINE void account_ahead(struct account *a, const struct floor_block *next) {
    account_to(a, next->end + LANES_WIDTH < a->chain->n ? next->end + LANES_WIDTH : a->chain->n);
}

void floors_defer(struct floors_late *late, const struct state *now) {
    late->due = true;
    late->time = now->time;
    late->ground_a = now->ground_a[0];
}

LANES static void account_rest(struct account *a) {
    account_to(a, a->chain->n);
}

static void raise_all(struct results *r, const struct model *m, const struct state *s) {
    const struct floors_moment moment = floors_moment_of(m, s);
    raise(&m->chain, r, &moment);
    peaks_speed(r, 0, m->n_dof);
}

void floors_settle(struct floors_late *late, const struct model *m, const struct state *old,
                   const struct state *now) {
    if (late->possible) {
        struct account due = account_due(late, m, old, now);
        account_rest(&due);
        raise_all(late->results, m, now);
        late->due = false;
    }
}

double floors_speed(const struct work *w, const struct state *now) {
    const struct floors_late *late = &w->floors.late;
    double speed = w->totals->speed;
    for (int i = 0, n = late->possible ? w->model->n_dof : 0; i < n; i++) {
        double peak = late->results->peak[PEAK_VELOCITY][i];
        speed = number_max(speed, number_max(peak, fabs(now->v[i])));
    }
    return speed;
}

void floors_account(struct energy_account *a, struct results *r, const struct model *m,
                    const struct state *now, const struct state *next) {
    energy_step(a, m, now, next);
    raise_all(r, m, next);
}

LANES bool floors_move(struct work *w, const struct state *now, struct state *next) {
    const struct move move = move_of(w, now, next);
    struct account due = account_due(&w->floors.late, w->model, next, now);
    int64_t sign = 0;
    list_ends(&w->floors, &w->gaps, next);
    for (int i = 0; i < w->floors.n_block; i++) {
        const struct floor_block *b = &w->floors.block[i];
        account_ahead(&due, b);
        sign |= move_block(&move, NULL, b);
    }
    w->floors.late.due = false;
    return sign >= 0;
}

// A step as far as it is known to be one in free flight. `lines` NULL: all storeys are elastic.
LANES_INLINE bool fly(const struct flight *f, const struct floors_lines *lines,
                      const struct state *now, struct state *next) {
    struct work *w = f->work;
    const struct move move = move_of(w, now, next);
    struct account due = account_due(&w->floors.late, f->model, next, now);
    bool free = true;
    lanes_bits beyond = {0};
    for (int i = 0, group = 0; i < w->floors.n_block && free; i++) {
        const struct floor_block *b = &w->floors.block[i];
        account_ahead(&due, b);
        int64_t sign = move_block(&move, lines, b);
        if (lines) {
            floors_follow(&move.chain, lines, b->first, b->end, next->u, &beyond);
        }
        sign |= floors_any(&beyond) | floors_approach(f, group, f->group_end[i], now, next);
        group = f->group_end[i];
        free = sign >= 0;
    }
    account_to(&due, move.chain.n);
    w->floors.late.due = false;
    return free;
}

LANES bool floors_fly(const struct flight *f, const struct state *now, struct state *next) {
    return fly(f, NULL, now, next);
}

LANES bool floors_fly_on_lines(const struct flight *f, const struct state *now,
                               struct state *next) {
    const struct floors_lines lines = floors_lines_of(f, next);
    return fly(f, &lines, now, next);
}
