// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/ensemble_lanes.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "core/arena.h"
#include "core/number.h"
#include "solve/ensemble/ensemble_contacts.h"

static void alloc_contacts(struct ensemble_lanes *e, const struct model *m, struct arena *a) {
    e->gap = lanes_wide_array(a, m->n_contact, sizeof *e->gap);
    e->nearest = lanes_wide_array(a, m->n_contact, sizeof *e->nearest);
    e->contacts = ensemble_contacts_create(m, a);
    e->force = lanes_wide_array(a, m->n_contact, sizeof *e->force);
    e->acts = arena_alloc(a, (size_t)m->n_contact, sizeof *e->acts);
    e->pressed = arena_alloc(a, (size_t)m->n_contact, sizeof *e->pressed);
    e->end = arena_alloc(a, (size_t)m->n_contact, sizeof *e->end);
    for (int k = 0; e->nearest && e->end && k < m->n_contact; k++) {
        for (int i = 0; i < 2; i++) {
            e->end[k][i] = state_end(&m->link[k], m, i);
        }
        e->nearest[k].depth = -INFINITY - (wide){0.0};  // of runs that never enter too
    }
}

static void alloc_building(struct ensemble_building *b, const struct building *g, struct arena *a) {
    const int n = g->n_floor;
    const bool low = n <= INVERSE_FLOORS_MAX;
    *b = (struct ensemble_building){
        .shape = g,
        .number = lanes_wide_array(a, n * NUMBER_COUNT, sizeof(wide)),
        .factor = lanes_wide_array(a, n * FACTOR_COUNT, sizeof(wide)),
        .inverse = low ? lanes_wide_array(a, n * n, sizeof(wide)) : NULL,
    };
}

static void fill_factors(struct ensemble_factors *f, const struct model *m) {
    const wide none = {0.0};
    const double h = m->dt, b = m->beta * h * h, g = m->gamma * h;
    *f = (struct ensemble_factors){.h = h - none,
                                   .half = h * h / 2.0 - none,
                                   .b = b - none,
                                   .g = g - none,
                                   .per_b = 1.0 / b - none,
                                   .per_g = 1.0 / g - none};
}

bool ensemble_lanes_alloc(struct ensemble_lanes *e, const struct model *m,
                          const struct ensemble_steps *steps, struct arena *a) {
    const int n = m->n_dof;
    *e = (struct ensemble_lanes){
        .steps = steps,
        .n_building = m->n_building,
        .n_floor = n,
        .n_contact = m->n_contact,
        .h = m->dt,
        .factors = lanes_wide_array(a, 1, sizeof *e->factors),
        .now = lanes_wide_array(a, n, sizeof *e->now),
        .next = lanes_wide_array(a, n, sizeof *e->next),
        .trial = lanes_wide_array(a, n, sizeof *e->trial),
        .correction = lanes_wide_array(a, n, sizeof *e->correction),
        .kept = lanes_wide_array(a, n, sizeof *e->kept),
        .peak = lanes_wide_array(a, n, sizeof *e->peak),
        .peak_time = lanes_wide_array(a, n, sizeof *e->peak_time),
        .works = lanes_wide_array(a, 1, sizeof *e->works),
        .base = lanes_wide_array(a, ENSEMBLE_STRETCH, sizeof *e->base),
        .building = arena_alloc(a, (size_t)m->n_building, sizeof *e->building),
    };
    alloc_contacts(e, m, a);
    for (int k = 0; e->building && k < m->n_building; k++) {
        alloc_building(&e->building[k], &m->building[k], a);
    }
    if (arena_failed(a)) {
        return false;
    }
    fill_factors(e->factors, m);
    return true;
}

static bool is_small(double x) {
    return fabs(x) <= ENSEMBLE_LARGEST;
}

// Sets a number of a lane; false: it is too large.
static bool put(wide *to, int lane, double x) {
    (*to)[lane] = x;
    return is_small(x);
}

// Number i of all lanes.
static double *lanes_of(double *x, int i) {
    return x + (ptrdiff_t)i * WIDE_RUNS;
}

// The same for number i of `to`.
static bool put_at(double *to, int i, int lane, double x) {
    lanes_of(to, i)[lane] = x;
    return is_small(x);
}

static bool fill_inverse(double *inverse, int lane, struct effective *home) {
    const int n = home->building->n_floor;
    bool small = true;
    for (int i = 0; i < n; i++) {
        const double *column = effective_column(home, i);
        for (int j = 0; j < n; j++) {
            small &= put_at(inverse, i * n + j, lane, column[j]);
        }
    }
    return small;
}

static bool fill_building(struct ensemble_building *b, int lane, const struct chain *c,
                          struct effective *home) {
    bool small = true;
    b->multiplies = b->inverse && effective_prefers_inverse(home);
    for (int i = 0; i < b->shape->n_floor; i++) {
        const int j = b->shape->first + i;
        const ptrdiff_t at = (ptrdiff_t)i * EFFECTIVE_ABREAST;
        const double number[NUMBER_COUNT] = {
            [NUMBER_MASS] = c->mass[j],           [NUMBER_STIFFNESS] = c->stiffness[j],
            [NUMBER_BELOW] = c->damping_below[j], [NUMBER_OWN] = c->damping[j],
            [NUMBER_ABOVE] = c->damping_above[j],
        };
        for (int q = 0; q < NUMBER_COUNT; q++) {
            small &= put_at(b->number, i * NUMBER_COUNT + q, lane, number[q]);
        }
        small &= put_at(b->factor, i * FACTOR_COUNT + FACTOR_PIVOT, lane, home->pivot[at]);
        small &= put_at(b->factor, i * FACTOR_COUNT + FACTOR_OFF, lane, home->factor[at]);
    }
    return (!b->inverse || fill_inverse(b->inverse, lane, home)) && small;
}

bool ensemble_lanes_fill(struct ensemble_lanes *e, int lane, struct run *r) {
    const struct model *m = r->model;
    const struct ground *g = &m->ground[0];
    bool small = is_small(e->h);
    for (int k = 0; k < e->n_contact; k++) {
        small &= put(&e->gap[k].width, lane, m->link[k].gap);
        ensemble_contacts_fill(e, lane, m, k);
    }
    for (int i = 0; i < g->n_signal; i++) {
        small &= is_small(g->n_signal * signal_peak(&g->signal[i]));
    }
    for (int k = 0; k < e->n_building; k++) {
        small &= fill_building(&e->building[k], lane, &m->chain, &r->work.home[k]);
    }
    return small;
}

// Are all n_number numbers of x the same in the first n lanes?
static bool are_same(double *x, int n_number, int n) {
    bool same = true;
    for (int i = 0; same && i < n_number; i++) {
        const double *of = lanes_of(x, i);
        for (int lane = 1; lane < n; lane++) {
            same &= number_bits(of[lane]) == number_bits(of[0]);
        }
    }
    return same;
}

static void hold_once(double *x, int n_number) {
    for (int i = 0; i < n_number; i++) {
        x[i] = *lanes_of(x, i);
    }
}

void ensemble_lanes_share(struct ensemble_lanes *e, int n) {
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_building *b = &e->building[k];
        const int n_floor = b->shape->n_floor;
        double *array[] = {b->number, b->factor, b->inverse};
        const int size[] = {n_floor * NUMBER_COUNT, n_floor * FACTOR_COUNT,
                            b->inverse ? n_floor * n_floor : 0};
        bool same = true;
        for (int i = 0; i < 3; i++) {
            same = same && are_same(array[i], size[i], n);
        }
        b->held = same ? HELD_ONCE : HELD_BY_EACH;
        for (int i = 0; same && i < 3; i++) {
            hold_once(array[i], size[i]);
        }
    }
}

// What is copied between a run and its lane.
struct lane_array {
    wide *lanes;  // (n), `pitch` apart
    double *run;  // (n)
    int n;
    ptrdiff_t pitch;
};
enum { LANE_ARRAYS = 6 };

static void lane_arrays(const struct ensemble_lanes *e, struct state *s, struct energy_account *a,
                        struct lane_array array[LANE_ARRAYS]) {
    const struct lane_array all[LANE_ARRAYS] = {
        {&e->now->u, s->u, e->n_floor, sizeof *e->now / sizeof(wide)},
        {&e->now->v, s->v, e->n_floor, sizeof *e->now / sizeof(wide)},
        {&e->now->a, s->a, e->n_floor, sizeof *e->now / sizeof(wide)},
        {e->works->input_2x, a->input_2x, LANES_WIDTH, 1},
        {e->works->damping_2x, a->damping_2x, LANES_WIDTH, 1},
        {&e->works->ground, s->ground_a, 1, 1},
    };
    memcpy(array, all, sizeof all);
}

bool ensemble_lanes_enter(struct ensemble_lanes *e, int lane, struct run *r) {
    struct lane_array array[LANE_ARRAYS];
    bool small = true;
    e->steps->catch_up(e);
    lane_arrays(e, r->now, &r->energy, array);
    for (const struct lane_array *x = array; x < array + LANE_ARRAYS; x++) {
        for (int i = 0; i < x->n; i++) {
            small &= put(&x->lanes[i * x->pitch], lane, x->run[i]);
        }
    }
    for (int k = 0; k < e->n_contact; k++) {
        struct ensemble_nearest *p = &e->nearest[k];
        const double depth = fmin(r->work.gaps.nearest[k], 0.0);
        if (p->depth[lane] < depth) {
            p->depth[lane] = depth;
            p->time[lane] = r->work.gaps.time[k];
        }
        e->gap[k].limit[lane] = p->depth[lane];
    }
    e->works->beyond[lane] = 0;
    e->active[lane] = small ? -1 : 0;
    return small;
}

void ensemble_lanes_leave(struct ensemble_lanes *e, int lane, struct run *r, double time,
                          long n_step) {
    struct state *s = r->now;
    struct totals *t = &r->results->totals;
    struct lane_array array[LANE_ARRAYS];
    e->steps->catch_up(e);
    lane_arrays(e, s, &r->energy, array);
    for (const struct lane_array *x = array; x < array + LANE_ARRAYS; x++) {
        for (int i = 0; i < x->n; i++) {
            x->run[i] = x->lanes[i * x->pitch][lane];
        }
    }
    for (int i = 0; i < e->n_floor; i++) {
        t->speed = number_max(t->speed, e->peak[i].of[PEAK_VELOCITY][lane]);
    }
    for (int k = 0; k < e->n_contact; k++) {
        s->delta[k] = s->u[e->end[k][0]] - s->u[e->end[k][1]] - e->gap[k].width[lane];
    }
    s->time = time;
    t->steps += n_step;
    t->iterations += n_step;
    ensemble_lanes_clear(e, lane);
}

void ensemble_lanes_clear(struct ensemble_lanes *e, int lane) {
    e->active[lane] = 0;
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
            merge(&r->peak[q][i], &r->peak_time[q][i], e->peak[i].of[q][lane],
                  e->peak_time[i].of[q][lane]);
        }
    }
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_nearest *n = &e->nearest[k];
        merge(&r->deepest[k], &r->deepest_time[k], n->depth[lane], n->time[lane]);
    }
}
