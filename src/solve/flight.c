// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/flight.h"

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
    f->uniform = m->n_ground == 1 && m->n_load == 0;
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

unsigned flight_near(const struct flight *f, struct state *next) {
    int n = f->model->n_contact;
    contact_penetrations(f->work, next);
    for (int k = 0; k < n; k++) {
        if (next->delta[k] > 0.0) {
            return FLIGHT_ENDS;
        }
    }
    peaks_penetrations(f->results, n, next);
    return 0;
}

// What flight_step leaves out.
static void complete(const struct flight *f, struct state *s) {
    state_internal_forces(s, f->model, s->u, s->v);
    contact_penetrations(f->work, s);
    for (int i = 0; i < f->model->n_dof; i++) {
        s->total[i] = s->a[i] + s->base[i];
    }
}

// Times from step n on, and the ground accelerations then.
static void look_ahead(struct flight *f, long n) {
    f->ahead_from = n;
    for (int i = 0; i < FLIGHT_AHEAD; i++) {
        f->time[i] = model_time(f->model, n + i);
        f->ground[i] = 0.0;
    }
    const struct ground *g = &f->model->ground[0];
    for (int i = 0; f->uniform && i < g->n_signal; i++) {
        signal_add_values(&g->signal[i], FLIGHT_AHEAD, f->time, f->ground);
    }
}

static unsigned step_to(struct flight *f, const struct state *now, struct state *next, long n) {
    if (n < f->ahead_from || n >= f->ahead_from + FLIGHT_AHEAD) {
        look_ahead(f, n);
    }
    next->time = f->time[n - f->ahead_from];
    double ground = f->ground[n - f->ahead_from];
    if (f->uniform) {
        next->ground_a[0] = ground;
    } else {
        excitation_at(next, f->model, next->time);
    }
    return flight_step(f, now, next, ground);
}

static bool may_start(const struct flight *f, const struct state *s) {
    return f->possible && s->n_live == 0 && f->work->h == f->model->dt;
}

// Takes the account of n steps to the state s.
static void finish(const struct flight *f, struct state *s, long n) {
    struct totals *t = &f->results->totals;
    complete(f, s);
    peaks_speed(f->results, 0, f->model->n_dof);
    t->steps += n;
    t->iterations += n;
}

long flight_take(struct flight *f, struct state **now, struct state **next, long n, long end) {
    if (!may_start(f, *now)) {
        return n;
    }
    end = end < f->model->n_step ? end : f->model->n_step - 1;  // the last may be shorter
    state_open_links(*next);
    memset(f->work->settled, 0, (size_t)f->model->n_building * sizeof *f->work->settled);
    long start = n;
    while (n < end) {
        struct state *s = *next;
        unsigned events = step_to(f, *now, s, n + 1);
        if (events == FLIGHT_PEAK) {
            events = flight_peaks(f, s);
        }
        if (events == FLIGHT_ENDS) {
            break;
        }
        *next = *now;
        *now = s;
        n++;
    }
    if (n > start) {
        finish(f, *now, n - start);
    }
    return n;
}
