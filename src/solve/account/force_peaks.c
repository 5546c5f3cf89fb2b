// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/account/force_peaks.h"

#include <math.h>

#include "core/lanes.h"
#include "core/number.h"

static const struct fields_row list[] = {
    FIELD_VALUE(struct force_peaks, n),
    FIELD_VALUE(struct force_peaks, time),
    FIELD_ARRAY(struct force_peaks, drift, FIELD_FORCE_STATES),
};
const struct fields force_peaks_fields = FIELDS(list);

// Bounds are this share of a drift too wide, which is more than their rounding.
static const double WIDER = 1e-12;

bool force_peaks_alloc(struct force_peaks *p, const struct model *m, struct results *r,
                       struct arena *a) {
    p->model = m;
    p->results = r;
    for (int i = 0; i < m->n_force; i++) {
        r->force_max[i] = -INFINITY;
        r->force_min[i] = INFINITY;
    }
    p->middle = lanes_array(a, m->n_dof);
    p->radius = lanes_array(a, m->n_dof);
    return fields_alloc(&force_peaks_fields, m, p, a);
}

// The box of the drifts.
LANES_INLINE void force_peaks_box(const struct force_peaks *p) {
    const int n = p->model->chain.n;
    for (int i = 0; i < n; i += LANES_WIDTH) {
        lanes_wide high = LANES_AT(p->drift, i), low = high;
        for (int k = 1; k < p->n; k++) {
            const lanes_wide x = LANES_AT(p->drift + k * n, i);
            high = WIDE_LARGER(x, high);
            low = WIDE_CHOOSE(WIDE_LESS(x, low), x, low);
        }
        const lanes_wide size = WIDE_LARGER(WIDE_ABSOLUTE(high), WIDE_ABSOLUTE(low));
        *(lanes_wide *)(p->middle + i) = (high + low) / 2.0;
        *(lanes_wide *)(p->radius + i) = (high - low) / 2.0 + WIDER * size;
    }
}

// Takes force i of building g in all states of the batch.
static void force_peaks_compute(const struct force_peaks *p, const struct building *g, int i) {
    const int stride = lanes_whole(g->n_force);
    for (int k = 0; k < p->n; k++) {
        const double *drift = p->drift + k * p->model->chain.n + g->first;
        double sum = 0.0;
        for (int j = 0; j < g->n_floor; j++) {
            sum += g->force_by_drift[j * stride + i] * drift[j];
        }
        force_peaks_take(p->results, g->force + i, sum, p->time[k]);
    }
}

LANES_INLINE void force_peaks_search(const struct force_peaks *p, const struct building *g) {
    const int stride = lanes_whole(g->n_force);
    const double *middle = p->middle + g->first, *radius = p->radius + g->first;
    for (int i = 0; i < g->n_force; i += LANES_WIDTH) {
        lanes_wide centre = {0.0}, reach = {0.0};
        for (int j = 0; j < g->n_floor; j++) {
            const lanes_wide row = LANES_AT(g->force_by_drift + j * stride, i);
            centre += row * middle[j];
            reach += WIDE_ABSOLUTE(row) * radius[j];
        }
        const lanes_wide most = LANES_AT(p->results->force_max + g->force, i);
        const lanes_wide least = LANES_AT(p->results->force_min + g->force, i);
        const wide_bits beyond = WIDE_LESS(most, centre + reach) | WIDE_LESS(centre - reach, least);
        for (int k = 0; k < LANES_WIDTH && i + k < g->n_force; k++) {
            if (beyond[k]) {
                force_peaks_compute(p, g, i + k);
            }
        }
    }
}

LANES static void force_peaks_of_batch(const struct force_peaks *p) {
    force_peaks_box(p);
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
