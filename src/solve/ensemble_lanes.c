// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble_lanes.h"

#include <math.h>

#include "core/arena.h"
#include "core/number.h"

static bool alloc_state(struct ensemble_state *s, int n, struct arena *a) {
    wide **const part[] = {&s->u,       &s->v,        &s->a,         &s->external,
                           &s->damping, &s->input_2x, &s->damping_2x};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i] = lanes_wide_array(a, n);
        if (!*part[i]) {
            return false;
        }
    }
    return true;
}

static bool alloc_floors(struct ensemble_lanes *e, struct arena *a) {
    wide **const part[] = {&e->inertia, &e->stiffness, &e->below, &e->own,   &e->above, &e->u_trial,
                           &e->v_trial, &e->residual,  &e->total, &e->pivot, &e->factor};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i] = lanes_wide_array(a, e->n_dof);
        if (!*part[i]) {
            return false;
        }
    }
    for (int q = 0; q < PEAK_COUNT; q++) {
        e->peak[q] = lanes_wide_array(a, e->n_dof);
        e->peak_time[q] = lanes_wide_array(a, e->n_dof);
        if (!e->peak[q] || !e->peak_time[q]) {
            return false;
        }
    }
    return alloc_state(&e->now, e->n_dof, a) && alloc_state(&e->next, e->n_dof, a);
}

// A wall is the zero behind the floors.
static bool fill_ends(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    e->ends = arena_alloc(a, (size_t)m->n_link, sizeof *e->ends);
    for (int k = 0; e->ends && k < m->n_link; k++) {
        const int *dof = m->link[k].dof;
        e->ends[k].left = dof[0] == WALL ? m->n_dof : dof[0];
        e->ends[k].right = dof[1] == WALL ? m->n_dof : dof[1];
    }
    return e->ends != NULL;
}

static bool alloc_inverses(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    e->inverse = arena_alloc(a, (size_t)m->n_building, sizeof *e->inverse);
    for (int k = 0; e->inverse && k < m->n_building; k++) {
        int n = m->building[k].n_floor;
        if (effective_multiplies(&m->building[k])) {
            e->inverse[k] = lanes_wide_array(a, n * n);
            if (!e->inverse[k]) {
                return false;
            }
        }
    }
    return e->inverse != NULL;
}

bool ensemble_lanes_alloc(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    *e = (struct ensemble_lanes){
        .n_building = m->n_building,
        .n_dof = m->n_dof,
        .n_contact = m->n_contact,
        .building = m->building,
        .b = m->beta * m->dt * m->dt,
        .g = m->gamma * m->dt,
        .h = m->dt,
        .gap = lanes_wide_array(a, m->n_contact),
        .deepest = lanes_wide_array(a, m->n_contact),
        .deepest_time = lanes_wide_array(a, m->n_contact),
        .base = lanes_wide_array(a, ENSEMBLE_STRETCH),
    };
    return e->gap && e->deepest && e->deepest_time && e->base && alloc_floors(e, a) &&
           fill_ends(e, m, a) && alloc_inverses(e, m, a);
}

// Copies `x` (n) to a lane; false: one is too large.
static bool put(wide *to, int lane, const double *x, int n) {
    bool small = true;
    for (int i = 0; i < n; i++) {
        to[i][lane] = x[i];
        small &= fabs(x[i]) <= ENSEMBLE_LARGEST;
    }
    return small;
}

static void get(double *to, const wide *from, int lane, int n) {
    for (int i = 0; i < n; i++) {
        to[i] = from[i][lane];
    }
}

static bool fill_factors(struct ensemble_lanes *e, int lane, struct effective *home) {
    bool small = true;
    for (int k = 0; k < e->n_building; k++) {
        int first = e->building[k].first, n = e->building[k].n_floor;
        for (int i = 0; e->inverse[k] && i < n; i++) {
            const double *column = effective_column(&home[k], i);
            for (int j = 0; j < n; j++) {
                e->inverse[k][j * n + i][lane] = column[j];
                small &= fabs(column[j]) <= ENSEMBLE_LARGEST;
            }
        }
        small &= put(e->pivot + first, lane, home[k].pivot, n);
        small &= put(e->factor + first, lane, home[k].factor, n);
    }
    return small;
}

bool ensemble_lanes_fill(struct ensemble_lanes *e, int lane, struct run *r) {
    const struct model *m = r->model;
    const struct chain *c = &m->chain;
    bool small = e->h <= ENSEMBLE_LARGEST && m->n_dof <= ENSEMBLE_LARGEST;
    for (int i = 0; i < e->n_dof; i++) {
        e->inertia[i][lane] = -c->mass[i];
        small &= c->mass[i] <= ENSEMBLE_LARGEST;
    }
    small &= put(e->stiffness, lane, c->stiffness, e->n_dof);
    small &= put(e->below, lane, c->damping_below, e->n_dof);
    small &= put(e->own, lane, c->damping, e->n_dof);
    small &= put(e->above, lane, c->damping_above, e->n_dof);
    for (int k = 0; k < e->n_contact; k++) {
        e->gap[k][lane] = m->link[k].gap;
        small &= fabs(m->link[k].gap) <= ENSEMBLE_LARGEST;
        e->deepest[k][lane] = -INFINITY;
    }
    for (int i = 0; i < m->ground[0].n_signal; i++) {
        small &= signal_peak(&m->ground[0].signal[i]) <= ENSEMBLE_LARGEST / m->ground[0].n_signal;
    }
    return fill_factors(e, lane, r->work.home) && small;
}

bool ensemble_board(struct ensemble_lanes *e, int lane, const struct run *r) {
    const struct state *s = r->now;
    int n = e->n_dof;
    bool small = put(e->now.u, lane, s->u, n);
    small &= put(e->now.v, lane, s->v, n);
    small &= put(e->now.a, lane, s->a, n);
    put(e->now.external, lane, s->external, n);
    put(e->now.damping, lane, s->damping_force, n);
    put(e->now.input_2x, lane, r->energy.input_2x, n);
    put(e->now.damping_2x, lane, r->energy.damping_2x, n);
    for (int k = 0; k < e->n_contact; k++) {
        const struct link_peak *p = &r->results->link[k];
        if (e->deepest[k][lane] < fmin(p->penetration, 0.0)) {
            e->deepest[k][lane] = fmin(p->penetration, 0.0);
            e->deepest_time[k][lane] = p->penetration_time;
        }
    }
    e->aboard[lane] = small ? -1 : 0;
    return small;
}

void ensemble_leave(struct ensemble_lanes *e, int lane, struct run *r, double time, long n_step) {
    struct state *s = r->now;
    int n = e->n_dof;
    get(s->u, e->now.u, lane, n);
    get(s->v, e->now.v, lane, n);
    get(s->a, e->now.a, lane, n);
    get(s->external, e->now.external, lane, n);
    get(s->damping_force, e->now.damping, lane, n);
    get(r->energy.input_2x, e->now.input_2x, lane, n);
    get(r->energy.damping_2x, e->now.damping_2x, lane, n);
    for (int k = 0; k < e->n_contact; k++) {
        s->delta[k] = s->u[e->ends[k].left] - s->u[e->ends[k].right] - e->gap[k][lane];
    }
    s->time = time;
    struct totals *t = &r->results->totals;
    t->steps += n_step;
    t->iterations += n_step;
    for (int i = 0; i < n; i++) {
        t->speed = number_max(t->speed, e->peak[PEAK_VELOCITY][i][lane]);
    }
    e->aboard[lane] = 0;
}

// The larger of two peaks, and of equal ones the earlier.
static void merge(double *peak, double *time, double other, double other_time) {
    if (other > *peak || (other == *peak && other_time < *time)) {
        *peak = other;
        *time = other_time;
    }
}

void ensemble_lanes_merge(const struct ensemble_lanes *e, int lane, struct results *r) {
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int i = 0; i < e->n_dof; i++) {
            merge(&r->peak[q][i], &r->peak_time[q][i], e->peak[q][i][lane],
                  e->peak_time[q][i][lane]);
        }
    }
    for (int k = 0; k < e->n_contact; k++) {
        struct link_peak *p = &r->link[k];
        merge(&p->penetration, &p->penetration_time, e->deepest[k][lane], e->deepest_time[k][lane]);
        r->deepest[k] = p->penetration;
    }
}
