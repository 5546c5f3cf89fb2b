// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble_lanes.h"

#include <math.h>

#include "core/arena.h"
#include "core/number.h"

static bool alloc_contacts(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    e->contact = lanes_wide_array(a, m->n_contact, sizeof *e->contact);
    for (int k = 0; e->contact && k < m->n_contact; k++) {
        const int *dof = m->link[k].dof;
        e->contact[k].left = dof[0] == WALL ? m->n_dof : dof[0];
        e->contact[k].right = dof[1] == WALL ? m->n_dof : dof[1];
        e->contact[k].deepest = -INFINITY - (wide){0.0};  // of runs that never come aboard too
    }
    return e->contact != NULL;
}

static bool alloc_factors(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    e->factor = lanes_wide_array(a, m->n_dof, sizeof *e->factor);
    e->inverse = arena_alloc(a, (size_t)m->n_building, sizeof *e->inverse);
    for (int k = 0; e->factor && e->inverse && k < m->n_building; k++) {
        int n = m->building[k].n_floor;
        if (n <= INVERSE_FLOORS_MAX) {
            e->inverse[k] = lanes_wide_array(a, n * n, sizeof(wide));
            if (!e->inverse[k]) {
                return false;
            }
        }
    }
    return e->factor && e->inverse;
}

bool ensemble_lanes_alloc(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    const int n = m->n_dof;
    *e = (struct ensemble_lanes){
        .n_building = m->n_building,
        .n_floor = n,
        .n_contact = m->n_contact,
        .building = m->building,
        .b = m->beta * m->dt * m->dt,
        .g = m->gamma * m->dt,
        .h = m->dt,
        .floor = lanes_wide_array(a, n, sizeof *e->floor),
        .now = lanes_wide_array(a, n, sizeof *e->now),
        .next = lanes_wide_array(a, n, sizeof *e->next),
        .works = lanes_wide_array(a, 1, sizeof *e->works),
        .residual = lanes_wide_array(a, n, sizeof *e->residual),
        .correction = lanes_wide_array(a, n, sizeof *e->correction),
        .peak_time = lanes_wide_array(a, n, sizeof *e->peak_time),
        .base = lanes_wide_array(a, ENSEMBLE_STRETCH, sizeof *e->base),
    };
    return e->floor && e->now && e->next && e->works && e->residual && e->correction &&
           e->peak_time && e->base && alloc_contacts(e, m, a) && alloc_factors(e, m, a);
}

static bool is_small(double x) {
    return fabs(x) <= ENSEMBLE_LARGEST;
}

// Sets a number of a lane; false: it is too large.
static bool put(wide *to, int lane, double x) {
    (*to)[lane] = x;
    return is_small(x);
}

static bool fill_inverse(wide *inverse, int lane, struct effective *home) {
    const int n = home->building->n_floor;
    bool small = true;
    for (int i = 0; i < n; i++) {
        const double *column = effective_column(home, i);
        for (int j = 0; j < n; j++) {
            small &= put(&inverse[j * n + i], lane, column[j]);
        }
    }
    return small;
}

static bool fill_factors(struct ensemble_lanes *e, int lane, struct effective *home) {
    bool small = true;
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_factor *f = e->factor + e->building[k].first;
        for (int i = 0; i < e->building[k].n_floor; i++) {
            small &= put(&f[i].pivot, lane, home[k].pivot[i]);
            small &= put(&f[i].factor, lane, home[k].factor[i]);
        }
        if (e->inverse[k]) {
            small &= fill_inverse(e->inverse[k], lane, &home[k]);
        }
    }
    return small;
}

static bool fill_floors(struct ensemble_lanes *e, int lane, const struct chain *c) {
    bool small = true;
    for (int i = 0; i < e->n_floor; i++) {
        struct ensemble_floor *f = &e->floor[i];
        small &= put(&f->inertia, lane, -c->mass[i]);
        small &= put(&f->stiffness, lane, c->stiffness[i]);
        small &= put(&f->below, lane, c->damping_below[i]);
        small &= put(&f->own, lane, c->damping[i]);
        small &= put(&f->above, lane, c->damping_above[i]);
    }
    return small;
}

bool ensemble_lanes_fill(struct ensemble_lanes *e, int lane, struct run *r) {
    const struct model *m = r->model;
    const struct ground *g = &m->ground[0];
    bool small = is_small(e->h);
    for (int k = 0; k < e->n_contact; k++) {
        small &= put(&e->contact[k].gap, lane, m->link[k].gap);
    }
    for (int i = 0; i < g->n_signal; i++) {
        small &= is_small(g->n_signal * signal_peak(&g->signal[i]));
    }
    small &= fill_floors(e, lane, &m->chain);
    return fill_factors(e, lane, r->work.home) && small;
}

bool ensemble_board(struct ensemble_lanes *e, int lane, const struct run *r) {
    const struct state *s = r->now;
    bool small = true;
    for (int i = 0; i < e->n_floor; i++) {
        struct ensemble_state *f = &e->now[i];
        small &= put(&f->u, lane, s->u[i]);
        small &= put(&f->v, lane, s->v[i]);
        small &= put(&f->a, lane, s->a[i]);
    }
    for (int i = 0; i < LANES_WIDTH; i++) {
        e->works->input_2x[i][lane] = r->energy.input_2x[i];
        e->works->damping_2x[i][lane] = r->energy.damping_2x[i];
    }
    e->works->ground[lane] = s->ground_a[0];
    for (int k = 0; k < e->n_contact; k++) {
        struct ensemble_contact *c = &e->contact[k];
        const struct link_peak *p = &r->results->link[k];
        if (c->deepest[lane] < fmin(p->penetration, 0.0)) {
            c->deepest[lane] = fmin(p->penetration, 0.0);
            c->deepest_time[lane] = p->penetration_time;
        }
    }
    e->aboard[lane] = small ? -1 : 0;
    return small;
}

void ensemble_leave(struct ensemble_lanes *e, int lane, struct run *r, double time, long n_step) {
    struct state *s = r->now;
    struct totals *t = &r->results->totals;
    for (int i = 0; i < e->n_floor; i++) {
        const struct ensemble_state *f = &e->now[i];
        s->u[i] = f->u[lane];
        s->v[i] = f->v[lane];
        s->a[i] = f->a[lane];
        t->speed = number_max(t->speed, e->floor[i].peak[PEAK_VELOCITY][lane]);
    }
    for (int i = 0; i < LANES_WIDTH; i++) {
        r->energy.input_2x[i] = e->works->input_2x[i][lane];
        r->energy.damping_2x[i] = e->works->damping_2x[i][lane];
    }
    s->ground_a[0] = e->works->ground[lane];
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_contact *c = &e->contact[k];
        s->delta[k] = s->u[c->left] - s->u[c->right] - c->gap[lane];
    }
    s->time = time;
    t->steps += n_step;
    t->iterations += n_step;
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
        for (int i = 0; i < e->n_floor; i++) {
            const struct ensemble_floor *f = &e->floor[i];
            merge(&r->peak[q][i], &r->peak_time[q][i], f->peak[q][lane],
                  e->peak_time[i].of[q][lane]);
        }
    }
    for (int k = 0; k < e->n_contact; k++) {
        struct link_peak *p = &r->link[k];
        const struct ensemble_contact *c = &e->contact[k];
        merge(&p->penetration, &p->penetration_time, c->deepest[lane], c->deepest_time[lane]);
        r->deepest[k] = p->penetration;
    }
}
