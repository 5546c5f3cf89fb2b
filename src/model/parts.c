// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/parts.h"

#include <assert.h>

#include "core/lanes.h"

void parts_linear_respond(const struct part *p, const double *history, const double *drift,
                          const double *rate, const struct part_sums *to, double *after) {
    const size_t n = (size_t)p->n;
    (void)history, (void)rate, (void)after;
    assert(p->stiffness);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            if (to->shear) {
                to->shear[i] += p->stiffness[i * n + j] * drift[j];
            }
            if (to->by_drift) {
                to->by_drift[i * n + j] += p->stiffness[i * n + j];
            }
        }
    }
}

double parts_linear_stored(const struct part *p, const double *history, const double *drift) {
    const size_t n = (size_t)p->n;
    double sum = 0.0;
    (void)history;
    assert(p->stiffness);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            sum += drift[i] * p->stiffness[i * n + j] * drift[j];
        }
    }
    return sum / 2.0;
}

void parts_respond(const struct building *g, const double *history, const double *drift,
                   const double *rate, const struct part_sums *to, double *after) {
    if (g->elastic && !to->by_drift && !to->by_rate) {
        lanes_add_symmetric(g->n_dof, g->part_stiffness, drift, to->shear, to->shear);
        return;
    }
    for (int i = 0; i < g->n_part; i++) {
        const struct part *p = &g->part[i];
        p->kind->respond(p, history + p->history, drift, rate, to,
                         after ? after + p->history : NULL);
    }
}

bool parts_are_diagonal(const struct building *g) {
    bool all = true;
    for (int i = 0; i < g->n_part; i++) {
        all = all && (g->part[i].kind->traits & PART_DIAGONAL);
    }
    return all;
}

void parts_initial(const struct building *g, double *to) {
    const size_t n = g->n_part > 0 ? (size_t)g->n_dof : 0, step = g->damping_full ? 1 : n + 1;
    for (size_t i = 0; i < n * n; i += step) {
        *to++ = g->part_stiffness[i];
    }
    for (size_t i = 0; i < n * n; i += step) {
        *to++ = g->part_dashpot[i];
    }
}

double parts_stored(const struct building *g, const double *history, const double *drift) {
    assert(drift);
    double sum = 0.0;
    for (int i = 0; i < g->n_part; i++) {
        const struct part *p = &g->part[i];
        sum += p->kind->stored(p, history + p->history, drift);
    }
    return sum;
}

double parts_damped(const struct building *g, const double *history) {
    double sum = 0.0;
    for (int i = 0; i < g->n_part; i++) {
        const struct part *p = &g->part[i];
        sum += p->kind->damped ? p->kind->damped(p, history + p->history) : 0.0;
    }
    return sum;
}
