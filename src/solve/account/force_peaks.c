// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/account/account.h"

#include <math.h>

#include "core/arena.h"
#include "core/lanes.h"

static const struct fields_row list[] = {
    FIELD_VALUES(struct force_peaks, n, time),
    FIELD_ARRAY(struct force_peaks, action, FIELD_FORCE_STATES),
    FIELD_PART(struct force_peaks, yielding, yielding_fields),
};
const struct fields force_peaks_fields = FIELDS(list);

// Bounds are this share of an action too wide, which is more than their rounding.
static const double WIDER = 1e-12;

bool force_peaks_alloc(struct force_peaks *p, const struct model *m, struct results *r,
                       struct arena *a) {
    p->model = m;
    p->results = r;
    for (int i = 0; i < m->n_force; i++) {
        r->force_max[i] = -INFINITY;
        r->force_min[i] = INFINITY;
    }
    p->n_action = fields_actions(m);
    p->bow = lanes_array(a, p->n_action);
    p->turned =
        arena_alloc(a, m->n_force > 0 ? (size_t)p->n_action * FORCES_BATCH : 0, sizeof *p->turned);
    return yielding_alloc(&p->yielding, m, a) && fields_alloc(&force_peaks_fields, m, p, a);
}

#define LANES_OF(x, i) (*(const lanes *)((x) + (i)))
#define ABSOLUTE(x) ((lanes)((lanes_bits)(x)&INT64_MAX))
#define CHOOSE(mask, a, b)                                                                         \
    ((lanes)(((lanes_bits)(mask) & (lanes_bits)(a)) | (~(lanes_bits)(mask) & (lanes_bits)(b))))
#define LARGER(a, b) CHOOSE((b) < (a), a, b)
#define SMALLER(a, b) CHOOSE((a) < (b), a, b)

// How far the actions go from their lines.
LANES_INLINE void force_peaks_bend(const struct force_peaks *p) {
    const ptrdiff_t n = p->n_action;
    const double *end = p->action + (p->n - 1) * n;
    for (ptrdiff_t i = 0; i < n; i += LANES_VECTOR) {
        const lanes first = LANES_OF(p->action, i), last = LANES_OF(end, i);
        const lanes slope = (last - first) / (p->n > 1 ? p->n - 1 : 1);
        lanes bow = WIDER * LARGER(ABSOLUTE(first), ABSOLUTE(last));
        for (int k = 1; k < p->n - 1; k++) {
            const lanes apart = LANES_OF(p->action + k * n, i) - (first + slope * k);
            bow = LARGER(ABSOLUTE(apart), bow);
        }
        *(lanes *)(p->bow + i) = bow + WIDER * bow;
    }
}

// Where action j of building g stands in a state.
static inline int force_peaks_place(const struct force_peaks *p, const struct building *g, int j) {
    const int hinge = j - g->n_dof;
    return hinge < 0            ? g->first + j
           : hinge < g->n_hinge ? p->model->chain.n + g->first_hinge + hinge
                                : g->struck[hinge - g->n_hinge];
}

// Turns the actions of building g so that the values of one stand side by side.
static void force_peaks_turn(const struct force_peaks *p, const struct building *g) {
    for (int j = 0; j < building_n_action(g); j++) {
        const double *action = p->action + force_peaks_place(p, g, j);
        for (int k = 0; k < p->n; k++) {
            p->turned[j * FORCES_BATCH + k] = action[(ptrdiff_t)k * p->n_action];
        }
    }
}

// Takes force i of building g in all states of the batch.
LANES_INLINE void force_peaks_compute(const struct force_peaks *p, const struct building *g,
                                      int i) {
    const ptrdiff_t stride = lanes_whole(g->n_force);
    double force[FORCES_BATCH] = {0.0};
    for (int j = 0; j < building_n_action(g); j++) {
        const double by_action = g->force_by_action[j * stride + i];
        const double *action = p->turned + (ptrdiff_t)j * FORCES_BATCH;
        LANES_LOOP
        for (int k = 0; k < FORCES_BATCH; k++) {
            force[k] += by_action * action[k];
        }
    }
    for (int k = 0; k < p->n; k++) {
        peaks_member(p->results, g->force + i, force[k], p->time[k]);
    }
}

// Which of four forces of building g, from i on, may exceed their extremes?
LANES_INLINE void force_peaks_bound(const struct force_peaks *p, const struct building *g, int i,
                                    lanes_bits *beyond) {
    const ptrdiff_t stride = lanes_whole(g->n_force);
    const double *first = p->action, *bow = p->bow;
    const double *last = first + (ptrdiff_t)(p->n - 1) * p->n_action;
    lanes start = {0.0}, end = {0.0}, reach = {0.0};
    for (int j = 0; j < building_n_action(g); j++) {
        const lanes row = LANES_OF(g->force_by_action + j * stride, i);
        const int at = force_peaks_place(p, g, j);
        start += row * first[at];
        end += row * last[at];
        reach += ABSOLUTE(row) * bow[at];
    }
    const lanes most = LANES_OF(p->results->force_max + g->force, i);
    const lanes least = LANES_OF(p->results->force_min + g->force, i);
    *beyond = (lanes_bits)(most < LARGER(start, end) + reach) |
              (lanes_bits)(SMALLER(start, end) - reach < least);
}

// Computes the forces of building g that may exceed their extremes.
LANES_INLINE void force_peaks_search(const struct force_peaks *p, const struct building *g) {
    bool is_turned = false;
    for (int i = 0; i < g->n_force; i += LANES_VECTOR) {
        lanes_bits beyond;
        force_peaks_bound(p, g, i, &beyond);
        if (!(beyond[0] | beyond[1] | beyond[2] | beyond[3])) {
            continue;
        }
        if (!is_turned) {
            force_peaks_turn(p, g);
            is_turned = true;
        }
        for (int k = 0; k < LANES_VECTOR && i + k < g->n_force; k++) {
            if (beyond[k]) {
                force_peaks_compute(p, g, i + k);
            }
        }
    }
}

LANES static void force_peaks_of_batch(const struct force_peaks *p) {
    force_peaks_bend(p);
    for (int k = 0; k < p->model->n_building; k++) {
        if (p->model->building[k].n_force > 0) {
            force_peaks_search(p, &p->model->building[k]);
        }
    }
}

void force_peaks_flush(struct force_peaks *p) {
    if (p->n > 0) {
        force_peaks_of_batch(p);
        p->n = 0;
    }
}
