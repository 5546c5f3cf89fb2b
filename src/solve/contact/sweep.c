// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of a step is in sweep_step.h. A^-1 is almost diagonal, for beta h^2 K << M: links
// disturb each other where they share a floor, and little else.
//
// Laws are evaluated before the first sweep, a group of links at a time so that the cache holds
// them until they are visited; evaluations there need not wait for each other. From then on the
// tangent replaces the law, at little cost, and the law is evaluated again, at once, where that is
// not accurate enough. A link of a smooth law within that reach is settled, and passed over where
// the tangent gives no change that matters.
//
// A settled link is only disturbed by the changes of others after its own. They change its force by
//     |df_l| <= t / (1 + s) sum over m of |S_lm df_m| <= s sum of |S_lm| / S_ll max |df_m|,
// so that another sweep would change forces by such a share of what this one did. Where that does
// not matter there is no other sweep.
#include "solve/contact/contact.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/number.h"
#include "solve/contact/sweep_step.h"

bool sweep_init(struct link_scratch *p, const struct model *m, int k, struct arena *a) {
    const struct link *l = &m->link[k];
    const bool plain = link_is_plain(l);
    *p = (struct link_scratch){
        .end = {plain ? state_end(l, m, 0) : -1, plain ? state_end(l, m, 1) : -1},
        .link = l,
        .index = k,
        .law = l->law,
        .constant = l->constant,
        .gap = l->gap,
        .bilateral = l->bilateral,
        .moving_ground = l->moving_ground,
    };
    for (int side = 0; side < 2; side++) {
        if (l->row[side].n > 0) {
            p->combined[side] = lanes_array(a, m->building[l->building[side]].n_dof);
        }
    }
    return !arena_failed(a);
}

// A^-1 b' of an end that is a row, into `column` (n_floor in whole lanes).
static struct reach sweep_combine(struct effective *a, const struct link_row *row, double *column) {
    const int n = lanes_whole(a->building->n_dof);
    struct reach reach = {n, 0};
    memset(column, 0, (size_t)n * sizeof *column);
    for (int i = 0; i < row->n; i++) {
        const int floor = row->entry[i].dof - a->building->first;
        const double *one = effective_column(a, floor);
        const struct reach own = a->reach[floor];
        for (int j = 0; j < n; j++) {
            column[j] += row->entry[i].weight * one[j];
        }
        reach.from = own.from < reach.from ? own.from : reach.from;
        reach.to = own.to > reach.to ? own.to : reach.to;
    }
    return reach;
}

// How the floors of its building respond to the force of a link at one end. Returns the sum of the
// sizes of its column.
static double sweep_find_column(const struct work *w, struct link_scratch *p, int side) {
    const struct link *l = p->link;
    struct effective *a = &w->effective[l->building[side]];
    const int first = a->building->first;
    const bool plain = l->row[side].n == 0;
    double *combined = plain ? NULL : p->combined[side];
    const double *column = plain ? effective_column(a, l->dof[side] - first) : combined;
    const struct reach reach =
        plain ? a->reach[l->dof[side] - first] : sweep_combine(a, &l->row[side], combined);
    double flexibility = 0.0, size = 0.0;
    for (int i = 0, n = link_entries(l, side); i < n; i++) {
        const struct link_entry e = link_entry(l, side, i);
        flexibility += e.weight * column[e.dof - first];
    }
    for (int i = 0; i < a->building->n_dof; i++) {
        size += fabs(column[i]);
    }
    p->flexibility += flexibility;
    p->column[side] = column + reach.from;
    p->first[side] = first + reach.from;
    p->lanes[side] = reach.to - reach.from;
    return size;
}

void sweep_find_columns(const struct work *w, struct link_scratch *p) {
    double size = 0.0;
    p->factors = w->factors;
    p->flexibility = 0.0;
    if (p->resolved->factors != w->factors) {
        p->resolved->factors = w->factors;
        p->resolved->depth = 0.0;
    }
    for (int side = 0; side < 2; side++) {
        if (p->link->dof[side] != WALL) {
            size += sweep_find_column(w, p, side);
        }
    }
    p->coupling = number_max(w->most_links * size / p->flexibility - 1.0, 0.0);
    p->per_coupling = 1.0 / (p->flexibility * p->coupling + DBL_MIN);
}

void sweep_begin(struct work *w, const struct state *next, struct progress *s) {
    *s = (struct progress){0};
    w->n_acting = next->n_live;
    for (int i = 0; i < w->n_acting; i++) {
        int k = next->live[i];
        w->acting[i] = &w->link[k];
        w->link[k].force = next->link[k].force;
        s->largest = number_max(s->largest, fabs(next->link[k].force));
    }
}

// Evaluates the law of a link where it is.
static inline void sweep_evaluate_here(struct work *w, struct link_scratch *p, struct progress *s) {
    const bool always = true;
    bool safe;
    double x;
    sweep_see(w, p, &x);
    sweep_evaluate(w, p, &x, &always, s, &safe);
}

void sweep_prepare(struct work *w, const struct state *next, struct link_scratch *p) {
    p->trusted = p->branch == BRANCH_CLOSED && p->law->force && !p->clamped;
    p->open = false;
    p->stale = true;
    p->d_trial = sweep_across(p, w->u_trial) - p->gap;
    p->v_trial = sweep_across(p, w->v_trial);
    if (p->moving_ground) {
        p->d_trial += state_ground_gap(p->link, w->model, next->ground_u);
        p->v_trial += state_ground_gap(p->link, w->model, next->ground_v);
    }
    if (p->factors != w->factors) {
        sweep_find_columns(w, p);
    }
}

void sweep_gather(struct work *w, const struct state *next, int first, int end,
                  struct progress *s) {
    for (int i = first; i < end; i++) {
        struct link_scratch *p = w->acting[i];
        sweep_prepare(w, next, p);
        sweep_evaluate_here(w, p, s);
    }
    s->law_tolerance = s->tolerance;
}

void sweep_evaluate_again(struct work *w, struct progress *s) {
    bool looser = true;
    sweep_tighten(s, &looser);
    for (int i = 0, n = looser ? w->n_acting : 0; i < n; i++) {
        sweep_evaluate_here(w, w->acting[i], s);
    }
}

LANES int sweep_newton(struct work *w, int first, int end, struct progress *progress) {
    struct progress s = *progress;  // in registers
    int i = first;
    for (; i < end; i++) {
        const struct link_scratch *p = w->acting[i];
        bool safe = true;
        sweep_visit(w, w->acting[i], &safe, &s);
        if (!safe) {
            double d = p->d_trial + w->b * sweep_across(p, w->correction);
            if (!(p->open && d <= 0.0)) {
                break;
            }
            s.margin = number_min(s.margin, -d * w->per_b * p->per_coupling);  // it stays open
        }
    }
    *progress = s;
    return i;
}
