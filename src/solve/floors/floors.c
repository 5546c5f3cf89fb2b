// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method, where all but the links is linear and their forces are given: the
// blocks of floors, the forces of links on them, and when accounts are taken. The loops are in
// floor_steps.h.
#include "solve/floors/floors.h"

#include <math.h>

#include "core/arena.h"
#include "core/number.h"
#include "solve/floors/floor_terms.h"
#include "solve/newmark/newmark.h"

// A block has at least so many floors; buildings that are solved together stay together.
enum { FLOORS_LEAST = 192 };

// How many buildings from k on make up a block.
static int block_size(const struct model *m, int k) {
    int n = 0;
    int floors = 0;
    while (k + n < m->n_body && floors < FLOORS_LEAST) {
        const struct building *b = &m->building[k + n];
        int alike = effective_alike(b, m->n_body - k - n);
        floors += alike * b->n_dof;
        n += alike;
    }
    return n;
}

static struct floor_block block_from(const struct model *m, int k, int first) {
    struct floor_block b = {.building = k, .n_building = block_size(m, k), .first = first};
    const struct building *last = &m->building[k + b.n_building - 1];
    int end = last->first + last->n_dof;
    b.n = lanes_whole(end) - first;
    b.end = k + b.n_building < m->n_body ? end / LANES_WIDTH * LANES_WIDTH : lanes_whole(end);
    return b;
}

bool floors_alloc(struct work *w, struct arena *a) {
    const struct model *m = w->model;
    struct floors *f = &w->floors;
    int most = 0;
    *f = (struct floors){
        .block = arena_alloc(a, (size_t)m->n_body, sizeof *f->block),
    };
    if (!f->block) {
        return false;
    }
    for (int k = 0, first = 0; k < m->n_body; f->n_block++) {
        struct floor_block b = block_from(m, k, first);
        f->block[f->n_block] = b;
        most = b.n > most ? b.n : most;
        first = b.end;
        k += b.n_building;
    }
    f->residual = lanes_array(a, most + 2 * LANES_WIDTH);
    f->correction = lanes_array(a, most + 2 * LANES_WIDTH);
    f->u_trial = f->n_block == 1 ? w->u_trial : lanes_array(a, most);
    f->v_trial = f->n_block == 1 ? w->v_trial : lanes_array(a, most);
    return !arena_failed(a);
}

// Adds the forces of a run of links to the residual of building k, which is at one of its sides.
// Links that do not act have force 0.
static void push_run(const struct gap_run *r, int k, const struct link_state *link,
                     const struct floor_block *b, double *residual) {
    const bool left = r->building[0] == k;
    if (r->row) {
        const double force = link[r->first].force;
        link_push_at(r->row, left ? 0 : 1, left ? -force : force, residual - b->first);
        return;
    }
    double *end = residual + ((left ? r->left : r->right) - b->first);
    for (int i = 0; i < r->n; i++) {
        const double force = link[r->first + i].force;
        end[i] += left ? -force : force;
    }
}

void floors_push(struct work *w, const struct state *now, const struct state *next,
                 const struct floor_block *b) {
    const struct gaps *g = &w->gaps;
    if (w->floors.n_block == 1) {
        state_add_link_forces(next, w->model, w->floors.residual);
        return;
    }
    for (int k = b->building; k < b->building + b->n_building; k++) {
        if (g->is_touched[k]) {
            floors_trial(w, now, k);
        }
        for (int i = g->start[k]; g->is_touched[k] && i < g->start[k + 1]; i++) {
            const int run = g->of_building[i];
            if (g->acts[run]) {
                push_run(&g->run[run], k, next->link, b, w->floors.residual);
            }
        }
    }
}

LANES void floors_trial(struct work *w, const struct state *now, int k) {
    const struct building *g = &w->model->building[k];
    const double *restrict u = now->u, *restrict v = now->v, *restrict a = now->a;
    double *restrict u_t = w->u_trial, *restrict v_t = w->v_trial;
    const double h = w->h, half = h * h / 2.0;
    for (int i = g->first, end = i + lanes_whole(g->n_dof); i < end; i++) {
        u_t[i] = TRIAL_U(u[i], v[i], a[i], h, half);
        v_t[i] = TRIAL_V(v[i], a[i], h);
    }
}

void floors_account_to(struct work *w, struct energy_account *energy, struct results *results,
                       struct force_peaks *forces) {
    w->floors.account = (struct floors_account){
        .energy = energy,
        .results = results,
        .forces = forces && force_peaks_due(forces) ? forces : NULL,
        .defers = state_is_uniform(w->model) && !w->model->adaptive,
    };
}

// The steps with the widest vectors for which the processor has registers.
static const struct floors_steps *steps(void) {
    return LANES_WIDEST_OF(&floors_wide, &floors_narrow);
}

void floors_catch_up(struct work *w, const struct state *old, const struct state *now) {
    struct floors_account *account = &w->floors.account;
    if (account->due) {
        steps()->account(w, old, now, account->ground_a);
        account->due = false;
    }
}

double floors_speed(const struct work *w, const struct state *now) {
    const struct floors_account *account = &w->floors.account;
    const double *peak = account->results->peak[PEAK_VELOCITY];
    double speed = 0.0;
    for (int i = 0; i < w->model->n_dof; i++) {
        speed = number_max(speed, number_max(peak[i], account->defers ? fabs(now->v[i]) : 0.0));
    }
    return speed;
}

void floors_account(struct work *w, const struct state *now, const struct state *next) {
    struct floors_account *to = &w->floors.account;
    if (to->defers && state_is_linear(w->model)) {
        floors_defer(to, now);
    } else {
        steps()->account(w, now, next, now->ground_a[0]);
    }
}

bool floors_move(struct work *w, const struct state *now, struct state *next, const double *shear) {
    const bool finite = steps()->move(w, now, next, shear);
    gaps_update(&w->gaps, next, NULL);
    return finite;
}

void floors_correct_touched(struct work *w, const struct state *now, struct state *next) {
    steps()->correct(w, now, next);
    gaps_update(&w->gaps, next, w->gaps.is_touched);
}

long floors_fly(const struct flight *f, struct state **now, struct state **next, long n, long end) {
    return steps()->fly(f, now, next, n, end);
}
