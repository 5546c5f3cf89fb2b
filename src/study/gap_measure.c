// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/gap_measure.h"

#include <math.h>
#include <string.h>

static double force(const struct link_peak *p) {
    return p->force;
}

static double impulse(const struct link_peak *p) {
    return p->impulse;
}

static double impacts(const struct link_peak *p) {
    return (double)p->impacts;
}

const struct gap_measure_kind gap_measure_kinds[] = {
    {"force", &dimension_force, 0, force},
    {"drift", &dimension_length, PEAK_DRIFT, NULL},
    {"acceleration", &dimension_acceleration, PEAK_ACCELERATION, NULL},
    {"displacement", &dimension_length, PEAK_DISPLACEMENT, NULL},
    {"velocity", &dimension_velocity, PEAK_VELOCITY, NULL},
    {"storey_shear", &dimension_force, PEAK_SHEAR, NULL},
    {"impulse", &dimension_impulse, 0, impulse},
    {"impacts", &dimension_none, 0, impacts},
};
const int n_gap_measure_kind = sizeof gap_measure_kinds / sizeof gap_measure_kinds[0];

static double of_contacts(const struct gap_measure *edp, const struct model *m,
                          const struct results *r) {
    double most = 0.0;
    for (int i = 0; i < m->n_contact; i++) {
        most =
            edp->owner < 0 || edp->owner == i ? fmax(most, edp->kind->of_link(&r->link[i])) : most;
    }
    return most;
}

double gap_measure_value(const struct gap_measure *edp, const struct model *m,
                         const struct results *r) {
    if (edp->kind->of_link) {
        return of_contacts(edp, m, r);
    }
    double most = 0.0;
    for (int i = 0; i < m->n_building; i++) {
        const struct building *g = &m->building[i];
        const double *peak = r->peak[edp->kind->peak] + g->first;
        for (int floor = 0; floor < g->n_floor && (edp->owner < 0 || edp->owner == i); floor++) {
            most = fmax(most, peak[floor]);
        }
    }
    return most;
}

int gap_measure_find_owner(const struct gap_measure_kind *kind, const struct model *m,
                           const char *name) {
    const int n = kind->of_link ? m->n_contact : m->n_building;
    for (int i = 0; i < n; i++) {
        if (strcmp(kind->of_link ? m->link[i].name : m->building[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}
