// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/flight.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "solve/contact.h"
#include "solve/excitation.h"

static bool follows(const struct link *before, const struct link *l) {
    bool side_by_side = true;
    for (int i = 0; i < 2; i++) {
        side_by_side = side_by_side && l->building[i] == before->building[i] &&
                       (l->dof[i] == WALL || l->dof[i] == before->dof[i] + 1);
    }
    return side_by_side;
}

static struct gap_group group_from(const struct model *m, int k) {
    const struct link *l = &m->link[k];
    struct gap_group g = {.contact = k};
    for (int i = 0; i < 2; i++) {
        g.dof[i] = l->dof[i] == WALL ? m->n_dof : l->dof[i];
        g.ground[i] = l->moving_ground ? m->building[l->building[i]].ground : 0;
    }
    return g;
}

static void group_contacts(struct flight *f, const struct model *m) {
    int in_group = LANES_WIDTH;
    for (int k = 0; k < m->n_contact; k++) {
        if (in_group == LANES_WIDTH || !follows(&m->link[k - 1], &m->link[k])) {
            f->group[f->n_group++] = group_from(m, k);
            in_group = 0;
        }
        f->gap[(f->n_group - 1) * LANES_WIDTH + in_group++] = m->link[k].gap;
    }
}

// Are all links contacts with a law of force, and all buildings linear?
static bool is_possible(const struct model *m) {
    bool possible = m->n_link == m->n_contact && !m->chain.full_damping && m->n_storey_history == 0;
    for (int k = 0; k < m->n_link; k++) {
        possible = possible && !m->link[k].law->rebound;
    }
    return possible;
}

bool flight_alloc(struct flight *f, const struct model *m, struct arena *a) {
    f->model = m;
    f->possible = is_possible(m);
    size_t n = f->possible ? (size_t)m->n_contact : 0;
    f->group = arena_alloc(a, n, sizeof *f->group);
    f->gap = arena_alloc(a, n * LANES_WIDTH, sizeof *f->gap);
    f->ahead_from = -FLIGHT_AHEAD;
    if (!f->group || !f->gap) {
        return false;
    }
    for (size_t i = 0; i < n * LANES_WIDTH; i++) {
        f->gap[i] = INFINITY;
    }
    if (f->possible) {
        group_contacts(f, m);
    }
    return true;
}

static bool is_finite(const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_dof; i++) {
        if (!(fabs(s->u[i]) + fabs(s->v[i]) + fabs(s->a[i]) <= DBL_MAX)) {
            return false;
        }
    }
    return true;
}

// What flight_step leaves out.
static void complete(const struct flight *f, struct state *s) {
    state_internal_forces(s, f->model, s->u, s->v);
    contact_penetrations(f->work, s);
    for (int i = 0; i < f->model->n_dof; i++) {
        s->total[i] = s->a[i] + s->base[i];
    }
}

// The ground acceleration at step n, which repeats what excitation_at does.
static double ground_ahead(struct flight *f, long n) {
    if (n < f->ahead_from || n >= f->ahead_from + FLIGHT_AHEAD) {
        f->ahead_from = n;
        for (int i = 0; i < FLIGHT_AHEAD; i++) {
            f->ahead[i] = excitation_of_ground(&f->model->ground[0], model_time(f->model, n + i));
        }
    }
    return f->ahead[n - f->ahead_from];
}

static void excite(struct flight *f, struct state *s, long n) {
    const struct model *m = f->model;
    s->time = model_time(m, n);
    if (m->n_ground == 1 && m->n_load == 0) {
        s->ground_a[0] = ground_ahead(f, n);
        chain_ground(&m->chain, s->ground_a[0], s->base, s->external);
    } else {
        excitation_at(s, m, s->time);
    }
}

static bool may_start(const struct flight *f, const struct state *s) {
    return f->possible && s->n_live == 0 && f->work->h == f->model->dt;
}

long flight_take(struct flight *f, struct state **now, struct state **next, long n, long end) {
    long start = n;
    if (!may_start(f, *now)) {
        return n;
    }
    end = end < f->model->n_step ? end : f->model->n_step - 1;  // the last may be shorter
    state_open_links(*next);
    memset(f->work->settled, 0, (size_t)f->model->n_building * sizeof *f->work->settled);
    while (n < end) {
        struct state *s = *next;
        excite(f, s, n + 1);
        enum flight_outcome outcome = flight_step(f, *now, s);
        if (outcome == FLIGHT_PEAK) {
            complete(f, s);
            outcome = is_finite(f->model, s) ? outcome : FLIGHT_MEETS;
        }
        if (outcome == FLIGHT_MEETS) {
            break;
        }
        if (outcome == FLIGHT_PEAK) {
            peaks_update(f->results, f->model, s);
        }
        *next = *now;
        *now = s;
        n++;
    }
    if (n > start) {
        complete(f, *now);
        f->results->totals.steps += n - start;
        f->results->totals.iterations += n - start;
    }
    return n;
}
