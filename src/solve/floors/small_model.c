// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/floors/small_model.h"

#include <assert.h>
#include <limits.h>
#include <string.h>

#include "core/lanes.h"
#include "solve/newmark/flight.h"

static void fill_table(struct small_table *t, const struct model *m) {
    const struct chain *c = &m->chain;
    size_t n = (size_t)m->n_dof * sizeof(double);
    memcpy(t->stiffness, c->stiffness, n);
    for (int i = 0; i < m->n_dof; i++) {
        t->inertia[i] = -c->mass[i];
        memset(&t->joint[i], c->joint[i] != 0.0 ? UCHAR_MAX : 0, sizeof t->joint[i]);
        memset(&t->joint_above[i], c->joint[i + 1] != 0.0 ? UCHAR_MAX : 0, sizeof t->joint[i]);
    }
    memcpy(t->damping_below, c->damping_below, n);
    memcpy(t->damping, c->damping, n);
    memcpy(t->damping_above, c->damping_above, n);
}

bool small_alloc(struct small_model *small, const struct model *m, struct arena *a) {
    static_assert((int)SMALL_MAX <= (int)INVERSE_FLOORS_MAX, "none are solved by their factors");
    small->possible = state_is_uniform(m) && !m->chain.full_damping && m->n_dof <= SMALL_MAX;
    if (small->possible) {
        small->table = (void *)lanes_array(a, sizeof *small->table / sizeof(double));
        if (small->table) {
            small->steps = LANES_WIDEST_OF(&small_wide, &small_narrow);
            fill_table(small->table, m);
        }
    }
    return !small->possible || small->table;
}

void small_factor(struct work *w) {
    struct small_model *small = &w->small;
    bool kept = small->factors > 0 && w->model->n_storey_history == 0;
    if (small->factors == w->factors || kept) {
        return;
    }
    small->factors = w->factors;
    memset(small->rows, 0, sizeof small->rows);
    for (int k = 0; k < w->model->n_building; k++) {
        const struct building *g = &w->model->building[k];
        const int end = g->first + g->n_floor;
        for (int i = 0; i < g->n_floor; i++) {
            memcpy(small->table->inverse[g->first + i] + g->first,
                   effective_column(&w->effective[k], i), (size_t)g->n_floor * sizeof(double));
        }
        for (int j = g->first / LANES_WIDTH; j * LANES_WIDTH < end; j++) {
            struct small_rows *r = &small->rows[j];
            r->from = r->to == 0 ? g->first : r->from;
            r->to = end;
        }
    }
}

long small_take(const struct flight *f, struct state *s, long n, long end) {
    const struct small_steps *steps = f->work->small.steps;
    return (f->yields ? steps->fly_on_lines : steps->fly)(f, s, n, end);
}
