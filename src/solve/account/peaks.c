// SPDX-License-Identifier: GPL-3.0-or-later
// Envelopes over every computed step.
#include "solve/account/peaks.h"

#include <math.h>

#include "core/lanes.h"
#include "core/number.h"

// Contacts that are looked at together, of which few come nearer than ever.
enum { CONTACTS_TOGETHER = 4 * LANES_WIDTH };

const char *const peak_names[] = {"displacement", "velocity", "acceleration", "drift",
                                  "storey_shear"};

static const struct fields_row list[] = {
    FIELD_ARRAY(struct results, peak[PEAK_DISPLACEMENT], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak[PEAK_VELOCITY], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak[PEAK_ACCELERATION], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak[PEAK_DRIFT], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak[PEAK_SHEAR], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak_time[PEAK_DISPLACEMENT], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak_time[PEAK_VELOCITY], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak_time[PEAK_ACCELERATION], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak_time[PEAK_DRIFT], FIELD_FLOORS),
    FIELD_ARRAY(struct results, peak_time[PEAK_SHEAR], FIELD_FLOORS),
    FIELD_ARRAY(struct results, drift_rate, FIELD_FLOORS),
    FIELD_ARRAY(struct results, residual_drift, FIELD_FLOORS),
    FIELD_ARRAY(struct results, deepest, FIELD_LINKS),
    FIELD_ARRAY(struct results, deepest_time, FIELD_LINKS),
    FIELD_ARRAY(struct results, link, FIELD_LINKS),
    FIELD_VALUE(struct results, energy),
    FIELD_VALUE(struct results, initial_energy),
    FIELD_VALUE(struct results, residual_peak),
    FIELD_VALUE(struct results, totals),
};
const struct fields results_fields = FIELDS(list);

bool peaks_alloc(struct results *r, const struct model *m, struct arena *a) {
    if (!fields_alloc(&results_fields, m, r, a)) {
        return false;
    }
    for (int q = 0; q < PEAK_COUNT; q++) {
        lanes_assert(r->peak[q], m->n_dof);
        lanes_assert(r->peak_time[q], m->n_dof);
    }
    for (int i = m->n_dof; i < m->chain.n; i++) {
        r->peak[PEAK_ACCELERATION][i] = INFINITY;  // the ground shakes there too
    }
    for (int k = 0; k < m->n_contact; k++) {
        r->deepest[k] = -INFINITY;
    }
    return true;
}

void peaks_finish(struct results *r, const struct model *m) {
    for (int k = 0; k < m->n_link; k++) {
        r->link[k].penetration = r->deepest[k];
        r->link[k].penetration_time = r->deepest_time[k];
    }
}

LANES static void peaks_raise(int first, int n, const double *restrict x, double time,
                              double *restrict peak, double *restrict peak_time) {
    for (int i = first, end = first + lanes_whole(n); i < end; i++) {
        peak_raise(x[i], time, &peak[i], &peak_time[i]);
    }
}

// The largest of x and `other`.
LANES static double peaks_largest(int first, int n, const double *restrict x, double other) {
    double most[LANES_WIDTH];
    for (int lane = 0; lane < LANES_WIDTH; lane++) {
        most[lane] = other;
    }
    for (int i = first, end = first + lanes_whole(n); i < end; i += LANES_WIDTH) {
        for (int lane = 0; lane < LANES_WIDTH; lane++) {
            most[lane] = number_max(most[lane], x[i + lane]);
        }
    }
    for (int lane = 1; lane < LANES_WIDTH; lane++) {
        most[0] = number_max(most[0], most[lane]);
    }
    return most[0];
}

void peaks_speed(struct results *r, int first, int n) {
    r->totals.speed = peaks_largest(first, n, r->peak[PEAK_VELOCITY], r->totals.speed);
}

LANES static bool peaks_any_exceeds(int n, const double *restrict x, const double *restrict limit) {
    long above = 0;
    for (int i = 0, end = lanes_whole(n); i < end; i++) {
        above |= x[i] > limit[i];
    }
    return above != 0;
}

static void peaks_raise_penetrations(struct results *r, int n, const struct state *s) {
    for (int first = 0; first < n; first += CONTACTS_TOGETHER) {
        int end = n - first < CONTACTS_TOGETHER ? n : first + CONTACTS_TOGETHER;
        bool any = peaks_any_exceeds(end - first, s->delta + first, r->deepest + first);
        for (int k = first; any && k < end; k++) {
            peaks_penetration(r, k, s->delta[k], s->time);
        }
    }
}

static void peaks_raise_floors(struct results *r, const struct model *m, const struct state *s) {
    const double *const value[PEAK_COUNT] = {
        [PEAK_DISPLACEMENT] = s->u, [PEAK_VELOCITY] = s->v,  [PEAK_ACCELERATION] = s->total,
        [PEAK_DRIFT] = s->drift,    [PEAK_SHEAR] = s->shear,
    };
    for (int q = 0; q < PEAK_COUNT; q++) {
        peaks_raise(0, m->n_dof, value[q], s->time, r->peak[q], r->peak_time[q]);
    }
    peaks_speed(r, 0, m->n_dof);
}

void peaks_drift_rates(struct results *r, const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_dof; i++) {
        double below = m->chain.joint[i] != 0.0 ? s->v[i - 1] : 0.0;
        r->drift_rate[i] = number_max(r->drift_rate[i], fabs(s->v[i] - below));
    }
}

void peaks_update(struct results *r, const struct model *m, const struct state *s) {
    lanes_assert(s->u, m->n_dof);
    lanes_assert(s->v, m->n_dof);
    lanes_assert(s->total, m->n_dof);
    peaks_raise_floors(r, m, s);
    peaks_raise_penetrations(r, m->n_contact, s);
    for (int i = 0; i < s->n_live; i++) {
        peaks_link(r, m, s, s->live[i]);
    }
}
