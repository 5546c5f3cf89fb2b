// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/parts.h"

#include "core/lanes.h"

void parts_respond(const struct building *g, const double *history, const double *drift,
                   const double *rate, const struct part_sums *to, double *after) {
    if (g->elastic && !to->by_drift && !to->by_rate) {
        lanes_add_symmetric(g->n_floor, g->part_stiffness, drift, to->shear, to->shear);
        return;
    }
    for (int i = 0; i < g->n_part; i++) {
        const struct part *p = &g->part[i];
        p->kind->respond(p, history + p->history, drift, rate, to,
                         after ? after + p->history : NULL);
    }
}

double parts_stored(const struct building *g, const double *history, const double *drift) {
    double sum = 0.0;
    for (int i = 0; i < g->n_part; i++) {
        const struct part *p = &g->part[i];
        sum += p->kind->stored(p, history + p->history, drift);
    }
    return sum;
}
