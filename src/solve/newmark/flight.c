// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/newmark/flight.h"

#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/number.h"
#include "solve/account/peaks.h"
#include "solve/contact/contact.h"
#include "solve/excitation.h"

// The runs of contacts, a vector at a time.
static void group_contacts(struct flight *f, const struct gaps *gaps) {
    const struct model *m = f->model;
    for (int i = 0; i < m->n_contact; f->n_group++) {
        const struct gap_run *r = &gaps->run[gaps->run_of[i]];
        const struct link *l = &m->link[i];
        const int left = r->first + r->n - i, n = left < LANES_WIDTH ? left : LANES_WIDTH;
        struct gap_group *g = &f->group[f->n_group];
        *g = (struct gap_group){.contact = i};
        for (int side = 0; side < 2; side++) {
            g->dof[side] = state_end(l, m, side);
            g->ground[side] = l->moving_ground ? m->building[l->building[side]].ground : 0;
        }
        memcpy(f->gap + (ptrdiff_t)f->n_group * LANES_WIDTH, gaps->gap + i,
               (size_t)n * sizeof *f->gap);
        i += n;
    }
}

// The last building of a group.
static int last_building(const struct flight *f, int group) {
    const int *k = f->model->link[f->group[group].contact].building;
    return k[0] > k[1] ? k[0] : k[1];
}

// Assigns each group to the first block of floors after which both its ends are known, in order.
static void assign_groups(struct flight *f) {
    const struct floors *floors = &f->work->floors;
    int group = 0;
    for (int i = 0; i < floors->n_block; i++) {
        const struct floor_block *b = &floors->block[i];
        bool last = i == floors->n_block - 1;
        while (group < f->n_group &&
               (last || last_building(f, group) < b->building + b->n_building)) {
            group++;
        }
        f->group_end[i] = group;
    }
}

// Are all links contacts of floors with a law of force, all storeys of straight lines, and
// buildings with full matrices elastic?
static bool is_possible(const struct model *m) {
    bool possible = m->n_link == m->n_contact && (m->elastic || !m->chain.full_damping);
    for (int k = 0; k < m->n_link; k++) {
        possible = possible && !m->link[k].law->rebound && link_is_plain(&m->link[k]);
    }
    for (int i = 0; i < m->n_dof; i++) {
        possible = possible && m->storey[i].law->branch;
    }
    return possible;
}

static void find_branches(struct flight *f, const double *history) {
    for (int i = 0; i < f->model->n_dof; i++) {
        const struct storey *s = &f->model->storey[i];
        const double *h = s->law->n_history > 0 ? history + s->history : NULL;
        struct storey_branch b = s->law->branch(s->constant, h);
        f->back[i] = b.back;
        f->spring[i] = b.spring;
        f->rest[i] = b.rest;
        f->limit[i] = b.limit;
    }
}

// Are the buildings factorised for the branches, and do low ones have their inverse?
static bool is_factorised(const struct flight *f) {
    for (int k = 0; k < f->model->n_building; k++) {
        const struct effective *e = &f->work->effective[k];
        const struct building *g = e->building;
        for (int i = 0; !g->elastic && i < g->n_floor; i++) {
            if (e->tangent[i] != f->back[g->first + i] + f->spring[g->first + i]) {
                return false;
            }
        }
        if (effective_prefers_inverse(e) && !effective_has_inverse(e)) {
            return false;
        }
    }
    return true;
}

bool flight_alloc(struct flight *f, struct work *w, struct arena *a) {
    const struct model *m = w->model;
    *f = (struct flight){
        .model = m,
        .work = w,
        .account = &w->floors.account,
        .possible = is_possible(m),
        .on_lines = !state_is_linear(m),
        .uniform = state_is_uniform(m),
    };
    size_t n = f->possible ? (size_t)m->n_contact : 0;
    f->group = arena_alloc(a, n, sizeof *f->group);
    f->gap = arena_alloc(a, n * LANES_WIDTH, sizeof *f->gap);
    f->group_end = arena_alloc(a, (size_t)m->n_building, sizeof *f->group_end);
    f->back = lanes_array(a, m->n_dof);
    f->spring = lanes_array(a, m->n_dof);
    f->rest = lanes_array(a, m->n_dof);
    f->limit = lanes_array(a, m->n_dof);
    if (arena_failed(a)) {
        return false;
    }
    for (size_t i = 0; i < n * LANES_WIDTH; i++) {
        f->gap[i] = INFINITY;
    }
    if (f->possible) {
        group_contacts(f, &w->gaps);
        assign_groups(f);
    }
    return true;
}

// Computes what steps in flight leave out.
static void complete(const struct flight *f, struct state *s) {
    const struct model *m = f->model;
    gaps_update(&f->work->gaps, s);
    gaps_peaks(&f->work->gaps, s);
    if (f->on_lines) {
        excitation_floors(s, m, s->time);
        state_internal_forces(s, m, s->u, s->v);
        state_totals(s, m);
    }
}

// Has a storey left its line in the step from `before`? Then it most likely will again in the next.
static bool has_yielded(const struct model *m, const struct state *before, const struct state *s) {
    return memcmp(before->storey_history, s->storey_history,
                  (size_t)m->n_storey_history * sizeof *s->storey_history) != 0;
}

static bool may_start(struct flight *f, const struct state *before, const struct state *s) {
    if (!f->possible || s->n_live > 0 || f->work->h != f->model->dt ||
        has_yielded(f->model, before, s)) {
        return false;
    }
    if (f->on_lines) {
        find_branches(f, s->storey_history);
    }
    return !f->on_lines || is_factorised(f);
}

static void start_flight(struct flight *f, const struct state *now, struct state *next) {
    const struct model *m = f->model;
    state_open_links(next);
    gaps_forget(&f->work->gaps);
    if (f->on_lines) {
        memcpy(next->storey_history, now->storey_history,
               (size_t)m->n_storey_history * sizeof *next->storey_history);
    }
}

// Accounts for n steps that end in state s, and computes the internal forces of yielding storeys.
static void finish_flight(const struct flight *f, const struct state *old, struct state *s,
                          long n) {
    struct totals *t = &f->account->results->totals;
    if (f->on_lines) {
        floors_catch_up(f->work, old, s);
    }
    complete(f, s);
    peaks_speed(f->account->results, 0, f->model->n_dof);
    t->steps += n;
    t->iterations += n;
}

long flight_take(struct flight *f, struct state **now, struct state **next, long n, long end) {
    if (f->uniform) {
        excitation_foresee(&f->work->ahead, f->model, n + 1);
    }
    if (!may_start(f, *next, *now)) {
        return n;
    }
    end = end < f->model->n_step ? end : f->model->n_step - 1;  // the last may be shorter
    start_flight(f, *now, *next);
    const long first = n;
    n = floors_fly(f, now, next, n, end);
    if (n > first) {
        finish_flight(f, *next, *now, n - first);
    }
    return n;
}
