// SPDX-License-Identifier: GPL-3.0-or-later
// Extremes of the forces that follow from drifts, in a step. A force is linear in the
// displacements, so it goes on a polynomial as they do, and turns where that does.
#include <math.h>

#include "model/forces.h"
#include "solve/account/force_peaks.h"
#include "solve/dormand_prince/dp.h"

// Puts the forces of building `g`, or their rates, into `out` by displacements or velocities x.
static void dp_forces_of(const struct dp *p, const struct building *g, const double *x,
                         double *out) {
    double *drift = p->system.part_drift;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        drift[i] = x[i] - x[p->system.below[i]];
    }
    forces_at(g, drift + g->first, out);
}

static void dp_forces_note_turns(struct dp *p, int i, const struct motion *m) {
    const struct motion_pieces s = dp_motion_cut(m);
    for (int j = 1; j < s.n; j++) {
        force_peaks_take(p->results, i, s.d[j], p->now.time + s.x[j] * p->h);
    }
}

// The forces of one building: at the end of the step, and where they turn within it.
static void dp_forces_building(struct dp *p, const struct building *g, bool within) {
    const double *const x[DP_FORCES] = {p->now.u,  p->now.v,  p->now.a,
                                        p->next.u, p->next.v, p->next.a};
    for (int k = 0; k < DP_FORCES; k++) {
        dp_forces_of(p, g, x[k], p->force[k]);
    }
    double *const *f = p->force;  // forces, their rates and second rates, now and next
    for (int i = 0; i < g->n_force; i++) {
        const struct motion m = {
            .d = {f[0][i], f[3][i]}, .v = {f[1][i], f[4][i]}, .a = {f[2][i], f[5][i]}, .h = p->h};
        const double way = p->h * fabs(m.v[1]);
        const double most = p->results->force_max[g->force + i];
        const double least = p->results->force_min[g->force + i];
        force_peaks_take(p->results, g->force + i, m.d[1], p->next.time);
        if (within && m.v[0] * m.v[1] < 0.0 && (m.d[1] + way > most || m.d[1] - way < least)) {
            dp_forces_note_turns(p, g->force + i, &m);
        }
    }
}

void dp_forces_step(struct dp *p, bool within) {
    for (int k = 0; k < p->model->n_building; k++) {
        if (p->model->building[k].n_force > 0) {
            dp_forces_building(p, &p->model->building[k], within);
        }
    }
}
