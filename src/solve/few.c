// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in which links act.
#include "solve/few.h"

#include <limits.h>
#include <string.h>

#include "solve/few_loops.h"

static void fill_table(struct few_table *t, const struct model *m) {
    const struct chain *c = &m->chain;
    size_t n = (size_t)m->n_dof * sizeof(double);
    memcpy(t->mass, c->mass, n);
    memcpy(t->stiffness, c->stiffness, n);
    for (int i = 0; i < m->n_dof; i++) {
        memset(&t->joint[i], c->joint[i] != 0.0 ? UCHAR_MAX : 0, sizeof t->joint[i]);
        memset(&t->joint_above[i], c->joint[i + 1] != 0.0 ? UCHAR_MAX : 0, sizeof t->joint[i]);
    }
    memcpy(t->damping_below, c->damping_below, n);
    memcpy(t->damping, c->damping, n);
    memcpy(t->damping_above, c->damping_above, n);
}

bool few_alloc(struct few *few, const struct model *m, struct arena *a) {
    few->possible = state_is_uniform(m) && !m->chain.full_damping && m->n_dof <= FEW_MAX;
    if (few->possible) {
        few->table = (void *)lanes_array(a, sizeof *few->table / sizeof(double));
        if (few->table) {
            fill_table(few->table, m);
        }
    }
    return !few->possible || few->table;
}

void few_factor(struct few *few, const struct work *w) {
    bool kept = few->factors > 0 && w->model->n_storey_history == 0;
    if (few->factors == w->factors || kept) {
        return;
    }
    few->factors = w->factors;
    memset(few->rows, 0, sizeof few->rows);
    for (int k = 0; k < w->model->n_building; k++) {
        const struct building *g = &w->model->building[k];
        const int end = g->first + g->n_floor;
        for (int i = 0; i < g->n_floor; i++) {
            memcpy(few->table->inverse[g->first + i] + g->first,
                   effective_column(&w->effective[k], i), (size_t)g->n_floor * sizeof(double));
        }
        for (int j = g->first / LANES_WIDTH; j * LANES_WIDTH < end; j++) {
            struct few_rows *r = &few->rows[j];
            r->from = r->to == 0 ? g->first : r->from;
            r->to = end;
        }
    }
}

bool few_serves(const struct work *w) {
    return w->few.possible && w->model->n_storey_history == 0 && w->effective == w->home &&
           w->h == w->model->dt;
}

LANES_INLINE bool move(struct work *w, const struct state *now, struct state *next, int n) {
    alignas(LINE) double residual[FEW_MAX];
    struct few_floors start, trial, end;
    lanes q[VECTORS];
    lanes_bits sign = {0};
    few_load(now, NULL, n, &start);
    few_try(w, NULL, n, &start, next->ground_a[0], &trial, residual, &sign);
    state_add_link_forces(next, w->model, residual);
    few_solve(&w->few, n, residual, q);
    few_reach(w, n, &start, &trial, q, &end);
    few_put(trial.u, n, w->u_trial);
    few_put(trial.v, n, w->v_trial);
    few_put(q, n, w->correction);
    few_store(&end, NULL, n, next);
    few_weigh(n, &end, &sign);
    return floors_any(&sign) >= 0;
}

LANES bool few_move(struct work *w, const struct state *now, struct state *next) {
    few_factor(&w->few, w);
    return is_low(w->model) ? move(w, now, next, VECTORS / 2) : move(w, now, next, VECTORS);
}

LANES_INLINE void correct(const struct work *w, const struct state *now, struct state *next,
                          int n) {
    struct few_floors start, trial, end;
    lanes q[VECTORS];
    EACH_VECTOR(j, n) {
        start.a[j] = PART(now->a, j);
        trial.u[j] = PART(w->u_trial, j);
        trial.v[j] = PART(w->v_trial, j);
        q[j] = PART(w->correction, j);
    }
    few_reach(w, n, &start, &trial, q, &end);
    few_store(&end, NULL, n, next);
}

LANES void few_correct(const struct work *w, const struct state *now, struct state *next) {
    is_low(w->model) ? correct(w, now, next, VECTORS / 2) : correct(w, now, next, VECTORS);
}

LANES_INLINE void account(const struct few_table *t, struct energy_account *a, struct results *r,
                          const struct state *now, const struct state *next, int n) {
    struct few_floors start, end;
    struct few_works works;
    lanes_bits sign = {0};
    few_load(now, NULL, n, &start);
    few_load(next, NULL, n, &end);
    few_strain(t, NULL, n, &end, &sign);
    few_load_works(a, &works);
    few_add_works(t, n, &start, &end, now->ground_a[0] + next->ground_a[0], &works);
    few_store_works(&works, a);
    few_compare(r->peak, NULL, n, &end, next->ground_a[0], &sign);
    if (floors_any(&sign) < 0) {
        (void)few_raise(r, n, &end, next->time, next->ground_a[0]);
        peaks_speed(r, 0, n * LANES_VECTOR);
    }
}

LANES void few_account(const struct few *few, struct energy_account *a, struct results *r,
                       const struct model *m, const struct state *now, const struct state *next) {
    is_low(m) ? account(few->table, a, r, now, next, VECTORS / 2)
              : account(few->table, a, r, now, next, VECTORS);
}
