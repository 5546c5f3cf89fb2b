// SPDX-License-Identifier: GPL-3.0-or-later
// Envelopes over every computed step.
#include "solve/account/account.h"

#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "core/number.h"
#include "model/foundation.h"
#include "model/struck_column.h"

const char *const peak_names[] = {"displacement", "velocity", "acceleration", "drift",
                                  "storey_shear"};

static const struct fields_row list[] = {
    FIELD_ARRAYS(struct results, peak, FIELD_FLOORS),
    FIELD_ARRAYS(struct results, peak_time, FIELD_FLOORS),
    FIELD_ARRAYS(struct results, founded_peak, FIELD_FLOORS),
    FIELD_ARRAYS(struct results, founded_time, FIELD_FLOORS),
    FIELD_ARRAY(struct results, drift_rate, FIELD_FLOORS),
    FIELD_ARRAY(struct results, residual_drift, FIELD_FLOORS),
    FIELD_ARRAY(struct results, storey_demand, FIELD_FLOORS),
    FIELD_ARRAY(struct results, hinge_demand, FIELD_HINGES),
    FIELD_ARRAY(struct results, deepest, FIELD_LINKS),
    FIELD_ARRAY(struct results, deepest_time, FIELD_LINKS),
    FIELD_ARRAY(struct results, force_max, FIELD_FORCES),
    FIELD_ARRAY(struct results, force_max_time, FIELD_FORCES),
    FIELD_ARRAY(struct results, force_min, FIELD_FORCES),
    FIELD_ARRAY(struct results, force_min_time, FIELD_FORCES),
    FIELD_ARRAY(struct results, link, FIELD_LINKS),
    FIELD_VALUE(struct results, collapse),
    FIELD_ARRAY(struct results, column, FIELD_COLUMNS),
    FIELD_VALUES(struct results, energy, totals),
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

void peaks_columns(struct results *r, const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_column; i++) {
        const double spring = s->link[struck_column_spring(m, i)].force;
        for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
            peaks_column(&r->column[i][q], struck_column_force(&m->column[i], q, s->u, spring),
                         s->time);
        }
    }
}

static const enum peak founded_quantity[] = {PEAK_DRIFT, PEAK_SHEAR};

void peaks_founded(struct results *r, const struct model *m, const struct state *s) {
    double drift[FLOORS_MAX], shear[FLOORS_MAX];
    const double *const value[] = {drift, shear};
    for (const struct building *g = m->building; g < m->building + m->n_building; g++) {
        if (!foundation_differs(g)) {
            continue;
        }
        foundation_storeys(g, s->storey_history, s->drift + g->first, s->shear + g->first, drift,
                           shear);
        for (int q = 0; q < 2; q++) {
            for (int i = 0; i < g->n_floor; i++) {
                peaks_storey(r, founded_quantity[q], g->first + i, value[q][i], s->time);
            }
        }
    }
}

void peaks_finish(struct results *r, const struct model *m) {
    for (int k = 0; m->storeys_differ && k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        const size_t size = foundation_differs(g) ? (size_t)g->n_floor * sizeof(double) : 0;
        for (int q = 0; q < 2; q++) {
            const enum peak p = founded_quantity[q];
            memcpy(r->peak[p] + g->first, r->founded_peak[q] + g->first, size);
            memcpy(r->peak_time[p] + g->first, r->founded_time[q] + g->first, size);
        }
    }
    for (int k = 0; k < m->n_link; k++) {
        r->link[k].penetration = r->deepest[k];
        r->link[k].penetration_time = r->deepest_time[k];
    }
}

void peaks_drift_rates(struct results *r, const struct model *m, const struct state *s) {
    for (int i = 0; i < m->n_dof; i++) {
        double below = m->chain.joint[i] != 0.0 ? s->v[i - 1] : 0.0;
        r->drift_rate[i] = number_max(r->drift_rate[i], fabs(s->v[i] - below));
    }
}

void peaks_update(struct results *r, const struct model *m, const struct state *s) {
    const double *const value[PEAK_COUNT] = {
        [PEAK_DISPLACEMENT] = s->u, [PEAK_VELOCITY] = s->v,  [PEAK_ACCELERATION] = s->total,
        [PEAK_DRIFT] = s->drift,    [PEAK_SHEAR] = s->shear,
    };
    state_assert(s, m);
    for (int q = 0; q < PEAK_COUNT; q++) {
        for (int i = 0; i < m->n_dof; i++) {
            peak_larger(fabs(value[q][i]), s->time, &r->peak[q][i], &r->peak_time[q][i]);
        }
    }
    if (m->storeys_differ) {
        peaks_founded(r, m, s);
    }
    peaks_columns(r, m, s);
    for (int k = 0; k < m->n_contact; k++) {
        peaks_penetration(r, k, s->delta[k], s->time);
    }
    for (int i = 0; i < s->n_live; i++) {
        peaks_link(r, m, s, s->live[i]);
    }
}
