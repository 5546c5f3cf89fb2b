// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/ensemble/ensemble_lockstep.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "core/arena.h"
#include "core/number.h"

static void ensemble_alloc_building(struct ensemble_building *b, const struct building *g,
                                    struct arena *a) {
    const int n = g->n_dof;
    const bool low = n <= INVERSE_FLOORS_MAX;
    *b = (struct ensemble_building){
        .shape = g,
        .number = lanes_wide_array(a, n * NUMBER_COUNT, sizeof(wide)),
        .factor = lanes_wide_array(a, n * FACTOR_COUNT, sizeof(wide)),
        .inverse = low ? lanes_wide_array(a, n * n, sizeof(wide)) : NULL,
    };
}

bool ensemble_lanes_alloc(struct ensemble_lanes *e, const struct model *m,
                          const struct ensemble_steps *steps, struct arena *a) {
    const int n = m->n_dof, n_contact = m->n_contact;
    const double h = m->dt, b = m->beta * h * h, g = m->gamma * h;
    *e = (struct ensemble_lanes){
        .steps = steps,
        .n_building = m->n_body,
        .n_floor = n,
        .n_contact = n_contact,
        .scheme = {h, h * h / 2.0, b, g, 1.0 / b, 1.0 / g},
        .line = m->elastic ? NULL : lanes_wide_array(a, n, sizeof *e->line),
        .storey_2x = lanes_wide_array(a, n, sizeof *e->storey_2x),
        .storey = m->storey,
        .now = lanes_wide_array(a, n, sizeof *e->now),
        .next = lanes_wide_array(a, n, sizeof *e->next),
        .trial = lanes_wide_array(a, n, sizeof *e->trial),
        .correction = lanes_wide_array(a, n, sizeof *e->correction),
        .kept = lanes_wide_array(a, n, sizeof *e->kept),
        .peak = lanes_wide_array(a, n, sizeof *e->peak),
        .peak_time = lanes_wide_array(a, n, sizeof *e->peak_time),
        .works = lanes_wide_array(a, 1, sizeof *e->works),
        .base = lanes_wide_array(a, ENSEMBLE_STRETCH, sizeof *e->base),
        .building = arena_alloc(a, (size_t)m->n_body, sizeof *e->building),
        .gap = lanes_wide_array(a, n_contact, sizeof *e->gap),
        .nearest = lanes_wide_array(a, n_contact, sizeof *e->nearest),
        .contacts = ensemble_contacts_create(m, a),
        .force = lanes_wide_array(a, n_contact, sizeof *e->force),
        .acts = arena_alloc(a, (size_t)n_contact, sizeof *e->acts),
        .pressed = arena_alloc(a, (size_t)n_contact, sizeof *e->pressed),
        .end = arena_alloc(a, (size_t)n_contact, sizeof *e->end),
    };
    for (int k = 0; e->building && k < m->n_body; k++) {
        ensemble_alloc_building(&e->building[k], &m->building[k], a);
    }
    if (arena_failed(a)) {
        return false;
    }
    for (int k = 0; k < n_contact; k++) {
        e->end[k][0] = state_end(&m->link[k], m, 0);
        e->end[k][1] = state_end(&m->link[k], m, 1);
        e->nearest[k].depth = -INFINITY - (wide){0.0};  // of runs that never enter too
    }
    return true;
}

static bool ensemble_is_small(double x) {
    return fabs(x) <= ENSEMBLE_LARGEST;
}

// Number i of all lanes.
static double *ensemble_lanes_of(double *x, int i) {
    return x + (ptrdiff_t)i * WIDE_RUNS;
}

// Sets number i of a lane. False: it is too large.
static bool ensemble_put(double *to, int i, int lane, double x) {
    ensemble_lanes_of(to, i)[lane] = x;
    return ensemble_is_small(x);
}

static bool ensemble_fill_building(struct ensemble_building *b, int lane, const struct chain *c,
                                   struct effective *home) {
    bool small = true;
    const int n = b->shape->n_dof;
    b->multiplies = b->inverse && effective_prefers_inverse(home);
    for (int i = 0; i < n; i++) {
        const int j = b->shape->first + i;
        const ptrdiff_t at = (ptrdiff_t)i * EFFECTIVE_ABREAST;
        const double number[NUMBER_COUNT] = {
            [NUMBER_MASS] = c->mass[j],           [NUMBER_STIFFNESS] = c->stiffness[j],
            [NUMBER_BELOW] = c->damping_below[j], [NUMBER_OWN] = c->damping[j],
            [NUMBER_ABOVE] = c->damping_above[j],
        };
        for (int q = 0; q < NUMBER_COUNT; q++) {
            small &= ensemble_put(b->number, i * NUMBER_COUNT + q, lane, number[q]);
        }
        small &= ensemble_put(b->factor, i * FACTOR_COUNT + FACTOR_PIVOT, lane, home->pivot[at]);
        small &= ensemble_put(b->factor, i * FACTOR_COUNT + FACTOR_OFF, lane, home->factor[at]);
        const double *column = b->inverse ? effective_column(home, i) : NULL;
        for (int k = 0; column && k < n; k++) {
            small &= ensemble_put(b->inverse, i * n + k, lane, column[k]);
        }
    }
    return small;
}

bool ensemble_lanes_fill(struct ensemble_lanes *e, int lane, struct run *r) {
    const struct model *m = r->model;
    const struct ground *g = &m->ground[0];
    bool small = ensemble_is_small(e->scheme.h);
    for (int k = 0; k < e->n_contact; k++) {
        small &= ensemble_put((double *)&e->gap[k].width, 0, lane, m->link[k].gap);
        ensemble_contacts_fill(e, lane, m, k);
    }
    for (int i = 0; i < g->n_signal; i++) {
        small &= ensemble_is_small(g->n_signal * signal_peak(&g->signal[i]));
    }
    for (int k = 0; k < e->n_building; k++) {
        struct effective *home = &r->work.home[k];
        small &= ensemble_fill_building(&e->building[k], lane, &m->chain, home);
        if (!m->building[k].elastic) {  // it has no inverse yet
            (void)effective_factor(home, home->b, home->g);
        }
    }
    return small;
}

// Are all n_number numbers of x the same in the first n lanes?
static bool ensemble_are_same(double *x, int n_number, int n) {
    bool same = true;
    for (int i = 0; same && i < n_number; i++) {
        const double *of = ensemble_lanes_of(x, i);
        for (int lane = 1; lane < n; lane++) {
            same &= number_bits(of[lane]) == number_bits(of[0]);
        }
    }
    return same;
}

void ensemble_lanes_share(struct ensemble_lanes *e, int n) {
    for (int k = 0; k < e->n_building; k++) {
        struct ensemble_building *b = &e->building[k];
        const int n_dof = b->shape->n_dof;
        double *array[] = {b->number, b->factor, b->inverse};
        const int size[] = {n_dof * NUMBER_COUNT, n_dof * FACTOR_COUNT,
                            b->inverse ? n_dof * n_dof : 0};
        b->once = !e->line;
        for (int i = 0; i < 3; i++) {
            b->once = b->once && ensemble_are_same(array[i], size[i], n);
        }
        for (int i = 0; b->once && i < 3; i++) {
            for (int j = 0; j < size[i]; j++) {
                array[i][j] = *ensemble_lanes_of(array[i], j);
            }
        }
    }
}

// Numbers that a run has, and those of its lane: n of them, there `pitch` apart.
struct ensemble_copy {
    wide *lanes;
    double *own;
    int n;
    ptrdiff_t pitch;
};
enum { FLOOR_ARRAYS = 7, STATE_PITCH = sizeof(struct ensemble_state) / sizeof(wide) };

// What the lanes hold of the floors of a run.
static void ensemble_floor_list(const struct ensemble_lanes *e, struct run *r,
                                struct ensemble_copy *list) {
    const struct state *s = r->now;
    const struct ensemble_copy all[FLOOR_ARRAYS] = {
        {&e->now->u, s->u, e->n_floor, STATE_PITCH},
        {&e->now->v, s->v, e->n_floor, STATE_PITCH},
        {&e->now->a, s->a, e->n_floor, STATE_PITCH},
        {e->works->input_2x, r->energy.input_2x, LANES_WIDTH, 1},
        {e->works->damping_2x, r->energy.damping_2x, LANES_WIDTH, 1},
        {&e->works->ground, s->ground_a, 1, 1},
        {e->storey_2x, r->energy.storey_2x, e->line ? e->n_floor : 0, 1},
    };
    memcpy(list, all, sizeof all);
}

bool ensemble_lanes_enter(struct ensemble_lanes *e, int lane, struct run *r) {
    struct ensemble_copy list[FLOOR_ARRAYS];
    e->steps->catch_up(e);
    ensemble_floor_list(e, r, list);
    bool small = true;
    for (const struct ensemble_copy *x = list; x < list + FLOOR_ARRAYS; x++) {
        for (int i = 0; i < x->n; i++) {
            x->lanes[i * x->pitch][lane] = x->own[i];
            small &= ensemble_is_small(x->own[i]);
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
    for (int i = 0; e->line && i < e->n_floor; i++) {
        struct ensemble_line *p = &e->line[i];
        p->back[lane] = r->flight.back[i];
        p->spring[lane] = r->flight.spring[i];
        p->rest[lane] = r->flight.rest[i];
        p->limit[lane] = r->flight.limit[i];
        small &= ensemble_is_small(p->spring[lane]) && ensemble_is_small(p->rest[lane]);
    }
    e->works->beyond[lane] = 0;
    e->active[lane] = small ? -1 : 0;
    return small;
}

// The larger of two peaks, and of equal ones the earlier.
static void ensemble_merge(double *peak, double *time, double other, double other_time) {
    if (other > *peak || (other == *peak && other_time < *time)) {
        *peak = other;
        *time = other_time;
    }
}

// Takes the peaks of one quantity of a lane into those of its run.
static void ensemble_merge_peaks(const struct ensemble_lanes *e, int lane, enum peak q,
                                 struct results *r) {
    for (int i = 0; i < e->n_floor; i++) {
        ensemble_merge(&r->peak[q][i], &r->peak_time[q][i], e->peak[i].of[q][lane],
                       e->peak_time[i].of[q][lane]);
    }
}

void ensemble_lanes_leave(struct ensemble_lanes *e, int lane, struct run *r, double time,
                          long n_step) {
    struct state *s = r->now;
    struct totals *t = &r->results->totals;
    struct ensemble_copy list[FLOOR_ARRAYS];
    e->steps->catch_up(e);
    ensemble_floor_list(e, r, list);
    for (const struct ensemble_copy *x = list; x < list + FLOOR_ARRAYS; x++) {
        for (int i = 0; i < x->n; i++) {
            x->own[i] = x->lanes[i * x->pitch][lane];
        }
    }
    ensemble_merge_peaks(e, lane, PEAK_VELOCITY, r->results);  // floors_speed needs them
    for (int k = 0; k < e->n_contact; k++) {
        s->delta[k] = ensemble_depth(e, k, e->now, lane);
    }
    s->time = time;
    if (e->line) {
        state_forces(s, r->model, s->storey_history, NULL);
    }
    t->steps += n_step;
    t->iterations += n_step;
}

// Adds what is stored below a floor on a line, and the work that has gone there, as energy_sums_of
// does.
static void ensemble_add_stored(const struct ensemble_lanes *e, int i, const wide *drift,
                                wide *elastic, wide *other, wide *storey_2x) {
    const struct ensemble_line *p = &e->line[i];
    const wide x = *drift - p->rest;
    const wide stored = (p->back * *drift * *drift + p->spring * x * x) / 2.0;
    if (e->storey[i].law->n_history == 0) {
        *elastic += stored;
    } else {
        *other += stored;
        *storey_2x += e->storey_2x[i];
    }
}

void ensemble_lanes_sum(const struct ensemble_lanes *e, struct energy_sums *sums) {
    wide kinetic_2x = {0.0}, elastic = {0.0}, other = {0.0}, storey_2x = {0.0};
    wide input = {0.0}, damping = {0.0};
    for (const struct ensemble_building *b = e->building; b < e->building + e->n_building; b++) {
        const bool once = b->once;
        wide under = {0.0};
        for (int i = 0; i < b->shape->n_dof; i++) {
            const struct ensemble_state *s = &e->now[b->shape->first + i];
            const wide drift = s->u - under;
            kinetic_2x += ENSEMBLE_AT(b->number, i * NUMBER_COUNT + NUMBER_MASS) * s->v * s->v;
            if (e->line) {
                ensemble_add_stored(e, b->shape->first + i, &drift, &elastic, &other, &storey_2x);
            } else {
                elastic += ENSEMBLE_AT(b->number, i * NUMBER_COUNT + NUMBER_STIFFNESS) * drift *
                           drift / 2.0;
            }
            under = s->u;
        }
    }
    for (int i = 0; i < LANES_WIDTH; i++) {
        input += e->works->input_2x[i];
        damping += e->works->damping_2x[i];
    }
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        sums[lane] = (struct energy_sums){.kinetic = kinetic_2x[lane] / 2.0,
                                          .elastic = elastic[lane],
                                          .other = other[lane],
                                          .storey = storey_2x[lane] / 2.0,
                                          .input_2x = input[lane],
                                          .damping_2x = damping[lane]};
    }
}

void ensemble_lanes_merge(const struct ensemble_lanes *e, int lane, struct results *r) {
    for (enum peak q = 0; q < PEAK_COUNT; q++) {
        ensemble_merge_peaks(e, lane, q, r);
    }
    for (int k = 0; k < e->n_contact; k++) {
        const struct ensemble_nearest *p = &e->nearest[k];
        ensemble_merge(&r->deepest[k], &r->deepest_time[k], p->depth[lane], p->time[lane]);
    }
}
