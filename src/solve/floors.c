// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method, where all is linear but for the links, whose forces f are given:
//     u_t = u + h v + h^2 a / 2,   v_t = v + h a,
//     A q = -M a_ground + p - M a - C v_t - K u_t - B' f,
//     u = u_t + beta h^2 q,   v = v_t + gamma h q,   a = a + q,
// and the works of the step and the tests for peaks. A block of buildings goes through all of it
// before the next one does. Lanes do not begin where buildings do: what a block computes of a
// neighbour's floors is computed by that one anew.
#include "solve/floors.h"

#include <string.h>

#include "core/arena.h"
#include "solve/contact.h"
#include "solve/floor_loops.h"

// Buildings of one height are solved by fours, and so many floors make a block.
enum { TOGETHER = 4, FLOORS_LEAST = 192 };

// Buildings from k on that make up a block.
static int block_size(const struct model *m, int k) {
    int n = 0;
    int floors = 0;
    while (k + n < m->n_building && (n % TOGETHER != 0 || floors < FLOORS_LEAST)) {
        floors += m->building[k + n++].n_floor;
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
static void list_ends(struct floors *f, const struct model *m, const struct state *s) {
    for (int i = 2 * s->n_live - 1; i >= 0; i--) {
        int end = 2 * s->live[i / 2] + i % 2;
        int k = m->link[end / 2].building[end % 2];
        if (k != WALL) {
            f->following_end[end] = f->first_end[k];
            f->first_end[k] = end;
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
            double force = next->force[end / 2];
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

// The corrections that the floors of a block want. Negative if a storey is beyond its line.
LANES_INLINE int64_t solve(struct work *w, const struct floors_lines *lines,
                           const struct state *now, const struct state *next,
                           const struct floor_block *b) {
    const struct chain c = w->model->chain;
    const struct floors_of from = floors_of(now);
    const double *external = state_is_uniform(w->model) ? NULL : next->external;
    double *r = w->floors.residual, *q = w->correction;
    int first = w->model->building[b->building].first;
    int64_t sign =
        floors_unbalance(&c, lines, w->h, b->first, b->n, &from, next->ground_a[0], external, r);
    if (next->n_live > 0) {
        push(w, now, next, b);
    }
    solve_row(&w->effective[b->building], b->n_building, r + (first - b->first), q + first);
    return sign;
}

void floors_trial(struct work *w, const struct state *now, int k) {
    const struct building *g = &w->model->building[k];
    const struct chain part = {.n = lanes_whole(g->n_floor)};
    const int i = g->first;
    chain_trial(&part, w->h, now->u + i, now->v + i, now->a + i, w->u_trial + i, w->v_trial + i);
}

// Takes the motion of the floors from `first` to `end` into their peaks. False: not finite.
LANES_INLINE bool raise_motion(int first, int end, const struct floors_moment *s,
                               const double *base, const struct results *r) {
    double *const *peak = r->peak, *const *when = r->peak_time;
    double *peak_u = peak[PEAK_DISPLACEMENT], *when_u = when[PEAK_DISPLACEMENT];
    double *peak_v = peak[PEAK_VELOCITY], *when_v = when[PEAK_VELOCITY];
    double *peak_a = peak[PEAK_ACCELERATION], *when_a = when[PEAK_ACCELERATION];
    const double *u = s->u, *v = s->v, *a = s->a;
    const double ground = s->ground, time = s->time;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = first, n = first + floors_whole(end - first); i < n; i++) {
        sign |= number_beyond(fabs(u[i]) + fabs(v[i]) + fabs(a[i]), DBL_MAX);
        peak_raise(u[i], time, &peak_u[i], &when_u[i]);
        peak_raise(v[i], time, &peak_v[i], &when_v[i]);
        peak_raise(a[i] + (base ? base[i] : ground), time, &peak_a[i], &when_a[i]);
    }
    return sign >= 0;
}

// The same of drifts and shears.
LANES_INLINE void raise_drifts(const struct chain *c, int first, int end,
                               const struct floors_moment *s, const double *shear,
                               const struct results *r) {
    double *const *peak = r->peak, *const *when = r->peak_time;
    double *peak_d = peak[PEAK_DRIFT], *when_d = when[PEAK_DRIFT];
    double *peak_s = peak[PEAK_SHEAR], *when_s = when[PEAK_SHEAR];
    const double *u = s->u, *k = c->stiffness, *joint = c->joint;
    const double time = s->time;
    LANES_LOOP
    for (int i = first, n = first + floors_whole(end - first); i < n; i++) {
        double drift = u[i] - joint[i] * u[i - 1];
        peak_raise(drift, time, &peak_d[i], &when_d[i]);
        peak_raise(shear ? shear[i] : k[i] * drift, time, &peak_s[i], &when_s[i]);
    }
}

// Takes what may be higher of the floors from `first` to `end` into the peaks. False: not finite.
LANES static bool raise(const struct chain *c, unsigned which, int first, int end,
                        const struct results *r, const struct floors_moment *s) {
    if (which & FLOORS_DRIFT && s->shear) {
        raise_drifts(c, first, end, s, s->shear, r);
    } else if (which & FLOORS_DRIFT) {
        raise_drifts(c, first, end, s, NULL, r);
    }
    if (!(which & FLOORS_MOTION)) {
        return true;
    }
    return s->base ? raise_motion(first, end, s, s->base, r) : raise_motion(first, end, s, NULL, r);
}

bool floors_raise(const struct flight *f, const struct state *s) {
    const struct floors_moment moment = floors_moment_of(f->model, s);
    const struct chain *c = &f->model->chain;
    return raise(c, FLOORS_MOTION | FLOORS_DRIFT, 0, c->n, f->results, &moment);
}

// The account of a step from s0 to s1, taken from floor `done` on.
struct account {
    const struct chain *chain;
    struct energy_account *energy;
    const struct results *results;
    struct floors_moment s0, s1;
    int done;
};

// Takes it as far as floor `end`.
LANES_INLINE void account_to(struct account *a, int end) {
    const struct chain c = *a->chain;
    const int first = a->done;
    lanes_wide_bits motion = {0}, drift = {0};
    if (first >= end) {
        return;
    }
    floors_add_step(&c, first, end, &a->s0, &a->s1, a->results->peak, a->energy, &motion, &drift);
    unsigned which = floors_which(&motion, &drift);
    if (which) {
        (void)raise(&c, which, first, end, a->results, &a->s0);
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

LANES static void account_block(struct account *a, int end) {
    account_to(a, end);
}

// Takes those floors from `first` to `end` into the peaks that are beyond them.
LANES static void raise_block(const struct chain *c, int first, int end, struct results *r,
                              const struct floors_moment *s) {
    lanes_wide_bits motion = {0}, drift = {0};
    for (int i = first; i < end; i += LANES_WIDTH) {
        floors_compare(c, s, r->peak, i, &motion, &drift);
    }
    unsigned which = floors_which(&motion, &drift);
    if (which) {
        (void)raise(c, which, first, end, r, s);
    }
    if (which & FLOORS_MOTION) {
        peaks_speed(r, first, end - first);
    }
}

// Takes the rest of an account, and the state at its end.
static void account_all(struct account *a, struct results *r) {
    const int n = a->chain->n;
    for (int first = 0; first < n; first += CHAIN_BLOCK) {
        int end = first + CHAIN_BLOCK < n ? first + CHAIN_BLOCK : n;
        account_block(a, end);
        raise_block(a->chain, first, end, r, &a->s1);
    }
}

void floors_settle(struct floors_late *late, const struct model *m, const struct state *old,
                   const struct state *now) {
    if (late->due) {
        struct account a = account_due(late, m, old, now);
        account_all(&a, late->results);
        peaks_speed(late->results, 0, m->n_dof);
        late->due = false;
    }
}

void floors_account(struct energy_account *a, struct results *r, const struct model *m,
                    const struct state *now, const struct state *next) {
    struct account account = {
        &m->chain, a, r, floors_moment_of(m, now), floors_moment_of(m, next), 0};
    account_all(&account, r);
    if (!state_is_uniform(m)) {
        energy_input(a, m, now, next);
    }
}

LANES bool floors_move(struct work *w, const struct state *now, struct state *next) {
    const struct floors_correction k = {w->correction, w->b, w->g, w->h};
    const struct floors_of from = floors_of(now), to = floors_of(next);
    struct account due = account_due(&w->floors.late, w->model, next, now);
    int64_t sign = 0;
    list_ends(&w->floors, w->model, next);
    for (int i = 0; i < w->floors.n_block; i++) {
        const struct floor_block *b = &w->floors.block[i];
        account_ahead(&due, b);
        (void)solve(w, NULL, now, next, b);
        sign |= floors_correct(&k, b->first, b->end, &from, &to);
    }
    w->floors.late.due = false;
    return sign >= 0;
}

// A step as far as it is known to be one in free flight. `lines` NULL: all storeys are elastic.
LANES_INLINE enum nearness fly(const struct flight *f, const struct floors_lines *lines,
                               const struct state *now, struct state *next) {
    struct work *w = f->work;
    const struct chain c = f->model->chain;
    const struct floors_correction k = {w->correction, w->b, w->g, w->h};
    const struct floors_of from = floors_of(now), to = floors_of(next);
    struct account due = account_due(&w->floors.late, f->model, next, now);
    enum nearness all = NEARNESS_FAR;
    lanes_bits beyond = {0};
    for (int i = 0, group = 0; i < w->floors.n_block && all != NEARNESS_CLOSED; i++) {
        const struct floor_block *b = &w->floors.block[i];
        account_ahead(&due, b);
        int64_t sign = solve(w, lines, now, next, b);
        sign |= floors_correct(&k, b->first, b->end, &from, &to);
        if (lines) {
            floors_follow(&c, lines, b->first, b->end, next->u, &beyond);
        }
        enum nearness own = floors_look(f, group, f->group_end[i], next->u, next->ground_u);
        group = f->group_end[i];
        own = sign < 0 || floors_any(&beyond) < 0 ? NEARNESS_CLOSED : own;
        all = own > all ? own : all;
    }
    account_to(&due, c.n);
    w->floors.late.due = false;
    return all;
}

LANES static enum nearness fly_elastic(const struct flight *f, const struct state *now,
                                       struct state *next) {
    return fly(f, NULL, now, next);
}

enum nearness floors_fly(const struct flight *f, const struct state *now, struct state *next) {
    return fly_elastic(f, now, next);
}

LANES static enum nearness fly_on_lines(const struct flight *f, const struct state *now,
                                        struct state *next) {
    const struct floors_lines lines = floors_lines_of(f, next);
    return fly(f, &lines, now, next);
}

enum nearness floors_fly_on_lines(const struct flight *f, const struct state *now,
                                  struct state *next) {
    enum nearness near = fly_on_lines(f, now, next);
    if (near != NEARNESS_CLOSED) {
        chain_storey_works(&f->model->chain, now->shear, next->shear, now->drift, next->drift,
                           f->energy->storey_2x);
    }
    return near;
}
