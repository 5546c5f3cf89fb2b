// SPDX-License-Identifier: GPL-3.0-or-later
// In a row of buildings links k, k + 1, ... join floors i, i + 1, ... of one building to floors j,
// j + 1, ... of the next, so that their penetrations are differences of stretches of one array.
#include "solve/contact/gaps.h"

#include <math.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/number.h"
#include "solve/account/account.h"

// Does link k carry on the run? A wall is all zeros behind the floors, which are no more than a
// vector.
static bool gaps_continue(const struct model *m, const struct gap_run *r, int k) {
    const struct link *l = &m->link[k];
    bool follows = !r->row && link_is_plain(l) && k != m->n_contact;
    for (int side = 0; side < 2; side++) {
        const int first = side == 0 ? r->left : r->right, end = state_end(l, m, side);
        follows = follows && l->building[side] == r->building[side] &&
                  (first < m->n_dof ? end == first + r->n : r->n < LANES_WIDTH);
    }
    return follows;
}

static void gaps_find_runs(struct gaps *g) {
    const struct model *m = g->model;
    int n_gap = 0;
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        g->limit[k] = -INFINITY;
        if (g->n_run == 0 || !gaps_continue(m, &g->run[g->n_run - 1], k)) {
            n_gap = lanes_whole(n_gap);
            g->run[g->n_run++] = (struct gap_run){.first = k,
                                                  .left = state_end(l, m, 0),
                                                  .right = state_end(l, m, 1),
                                                  .building = {l->building[0], l->building[1]},
                                                  .gap = n_gap,
                                                  .row = link_is_plain(l) ? NULL : l};
        }
        struct gap_run *r = &g->run[g->n_run - 1];
        for (int side = 0; l->moving_ground && side < 2; side++) {
            r->ground[side] = m->building[l->building[side]].ground;
        }
        r->n++;
        g->run_of[k] = g->n_run - 1;
        g->gap[n_gap++] = l->gap;
        for (int i = n_gap; i < lanes_whole(n_gap); i++) {
            g->gap[i] = INFINITY;
        }
    }
}

// Lists the runs at each building, by counting.
static void gaps_sort_runs(struct gaps *g) {
    for (int i = 0; i < 2 * g->n_run; i++) {
        int k = g->run[i / 2].building[i % 2];
        if (k != WALL) {
            g->start[k]++;
        }
    }
    for (int k = 1; k <= g->model->n_body; k++) {
        g->start[k] += g->start[k - 1];
    }
    for (int i = 2 * g->n_run - 1; i >= 0; i--) {
        int k = g->run[i / 2].building[i % 2];
        if (k != WALL) {
            g->of_building[--g->start[k]] = i / 2;
        }
    }
}

bool gaps_alloc(struct gaps *g, const struct model *m, const struct results *r, struct arena *a) {
    size_t n_link = (size_t)m->n_link;
    size_t n_building = (size_t)m->n_body;
    *g = (struct gaps){
        .model = m,
        .gap = arena_alloc(a, n_link, LANES_WIDTH * sizeof *g->gap),
        .limit = arena_alloc(a, n_link + LANES_WIDTH, sizeof *g->limit),
        .nearest = r->deepest,
        .time = r->deepest_time,
        .run_of = arena_alloc(a, n_link, sizeof *g->run_of),
        .beyond = arena_alloc(a, n_link, sizeof *g->beyond),
        .acting = arena_alloc(a, n_link, sizeof *g->acting),
        .acts = arena_alloc(a, n_link, sizeof *g->acts),
        .run = arena_alloc(a, n_link, sizeof *g->run),
        .start = arena_alloc(a, n_building + 1, sizeof *g->start),
        .of_building = arena_alloc(a, 2 * n_link, sizeof *g->of_building),
        .pressed = arena_alloc(a, n_link, sizeof *g->pressed),
        .touched = arena_alloc(a, n_building, sizeof *g->touched),
        .is_touched = arena_alloc(a, n_building, sizeof *g->is_touched),
    };
    if (arena_failed(a)) {
        return false;
    }
    gaps_find_runs(g);
    gaps_sort_runs(g);
    return true;
}

// The penetrations of a run, into delta (n_link); true if one is beyond its limit.
static inline bool gaps_update_run(const struct gaps *g, const struct gap_run *r,
                                   const double *restrict u, double *restrict delta) {
    const double *restrict left = u + r->left;
    const double *restrict right = u + r->right;
    const double *restrict gap = g->gap + r->gap;
    const double *restrict limit = g->limit + r->first;
    double *restrict d = delta + r->first;
    int64_t sign = 0;
    if (r->row) {
        d[0] = link_across(r->row, u) - gap[0];
        return limit[0] < d[0];
    }
    LANES_LOOP
    for (int j = 0, n = r->n; j < n; j++) {
        double x = left[j] - right[j] - gap[j];
        d[j] = x;
        sign |= number_bits(limit[j] - x);
    }
    return sign < 0;
}

// Does a link of the run that does not act stand inside?
static inline bool gaps_is_pressed(const struct gaps *g, const struct gap_run *r,
                                   const double *delta) {
    const double *restrict d = delta + r->first;
    const double *restrict limit = g->limit + r->first;
    long inside = 0;
    for (int j = 0, n = r->n; j < n; j++) {
        inside |= d[j] > number_max(limit[j], 0.0);
    }
    return inside != 0;
}

// Where grounds move differently, all runs may be beyond their limits and pressed.
LANES void gaps_update(struct gaps *g, struct state *s, const bool *moved) {
    const struct model *m = g->model;
    const bool grounds = m->n_ground > 1;
    g->n_pressed = 0;
    for (int i = 0; i < g->n_run; i++) {
        const struct gap_run *r = &g->run[i];
        const int *b = r->building;
        if (moved && !(b[0] != WALL && moved[b[0]]) && !(b[1] != WALL && moved[b[1]])) {
            continue;
        }
        g->beyond[i] = gaps_update_run(g, r, s->u, s->delta) || grounds;
        for (int k = r->first; grounds && k < r->first + r->n; k++) {
            s->delta[k] += state_ground_gap(&m->link[k], m, s->ground_u);
        }
        if (grounds || (g->beyond[i] && gaps_is_pressed(g, r, s->delta))) {
            g->pressed[g->n_pressed++] = i;
        }
    }
}

LANES void gaps_peaks(struct gaps *g, const struct state *s) {
    for (int i = 0; i < g->n_run; i++) {
        const struct gap_run *r = &g->run[i];
        const double *restrict d = s->delta + r->first;
        double *restrict nearest = g->nearest + r->first;
        double *restrict time = g->time + r->first;
        double *restrict limit = g->limit + r->first;
        for (int j = 0, n = g->beyond[i] ? r->n : 0; j < n; j++) {
            peak_larger(d[j], s->time, &nearest[j], &time[j]);
            limit[j] = limit[j] > 0.0 ? limit[j] : number_min(nearest[j], 0.0);
        }
    }
}

void gaps_forget(struct gaps *g) {
    for (int i = 0; i < g->n_acting; i++) {
        int k = g->acting[i];
        g->limit[k] = number_min(g->nearest[k], 0.0);
        g->acts[g->run_of[k]] = false;
    }
    for (int i = 0; i < g->n_touched; i++) {
        g->is_touched[g->touched[i]] = false;
    }
    g->n_acting = g->n_touched = 0;
}

void gaps_resume(struct gaps *g) {
    gaps_forget(g);
    g->n_pressed = 0;
    for (int k = 0; k < g->model->n_link; k++) {
        g->limit[k] = number_min(g->nearest[k], 0.0);
    }
}
