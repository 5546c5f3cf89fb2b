// SPDX-License-Identifier: GPL-3.0-or-later
// Extremes in a step of the forces that follow from drifts, of the forces in struck columns, and
// of the storeys of buildings with a foundation. A force is linear in the
// displacements, so it goes on a polynomial as they do, and turns where that does. With hinges, it
// is known at the ends of steps only.
#include <math.h>

#include "model/forces.h"
#include "model/foundation.h"
#include "model/struck_column.h"
#include "solve/account/force_peaks.h"
#include "solve/account/peaks.h"
#include "solve/dormand_prince/dp.h"

// Puts the forces of building `g`, or their rates, into `out` by displacements or velocities x.
static void dp_forces_of(const struct dp *p, const struct building *g, const double *x,
                         double *out) {
    double *drift = p->system.part_drift;
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        drift[i] = x[i] - x[p->system.below[i]];
    }
    for (int i = 0; i < g->n_struck; i++) {
        drift[g->struck[i]] = x[g->struck[i]];
    }
    forces_at(g, drift + g->first, p->next.storey_history, out);
}

static void dp_forces_note_turns(struct dp *p, int i, const struct motion *m) {
    const struct motion_pieces s = dp_motion_cut(m);
    for (int j = 1; j < s.n; j++) {
        force_peaks_take(p->results, i, s.d[j], p->now.time + s.x[j] * p->h);
    }
}

// The forces of a building with hinges at the end of the step, whose history dp_peaks.c has found.
static void dp_forces_hinged(const struct dp *p, const struct building *g) {
    const struct state *next = &p->next;
    dp_forces_of(p, g, next->u, p->force[0]);
    for (int i = 0; i < g->n_force; i++) {
        force_peaks_take(p->results, g->force + i, p->force[0][i], next->time);
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

// The motion of a sum of displacements.
static struct motion dp_forces_sum(const struct dp *p, int n, const int *dof,
                                   const double *weight) {
    struct motion m = {.h = p->h};
    const struct state *end[] = {&p->now, &p->next};
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < 2; k++) {
            m.d[k] += weight[i] * end[k]->u[dof[i]];
            m.v[k] += weight[i] * end[k]->v[dof[i]];
            m.a[k] += weight[i] * end[k]->a[dof[i]];
        }
    }
    return m;
}

// Forces in a struck column with a law: at the end of the step only.
static void dp_forces_yielding(const struct dp *p, int column) {
    const struct model *m = p->model;
    const struct link *l = &m->link[m->n_link - m->n_column + column];
    const double d = dp_system_across(l, m, p->next.u, p->next.ground_u);
    const double spring =
        l->law->force(l->constant, p->now.link_history + l->history, d, 0.0).force;
    for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
        peaks_column(&p->results->column[column][q],
                     struck_column_force(&m->column[column], q, p->next.u, spring), p->next.time);
    }
}

// Forces in struck columns at the end of the step and where they turn.
static void dp_forces_columns(const struct dp *p) {
    const struct model *m = p->model;
    for (int i = 0; i < m->n_column; i++) {
        const struct struck_column *c = &m->column[i];
        if (c->yields) {
            dp_forces_yielding(p, i);
            continue;
        }
        for (enum column_force q = 0; q < COLUMN_FORCE_COUNT; q++) {
            struct column_peak *peak = &p->results->column[i][q];
            const struct motion force =
                dp_forces_sum(p, c->n_dof, c->dof, c->force + (ptrdiff_t)q * c->n_dof);
            const struct motion_pieces s = dp_motion_cut(&force);
            for (int j = 1; j <= s.n; j++) {
                peaks_column(peak, s.d[j], p->now.time + s.x[j] * p->h);
            }
        }
    }
}

// Shear of storey i of a linear building with a foundation, or its rate (foundation.c).
static double dp_forces_founded_shear(const struct dp *p, const struct building *g, const double *x,
                                      int i) {
    const int n = g->n_dof;
    double sum = 0.0;
    for (int j = 0; j < n; j++) {
        const double drift = x[g->first + j] - x[p->system.below[g->first + j]];
        sum += (g->part_stiffness[i * n + j] - g->part_stiffness[g->n_floor * n + j]) * drift;
    }
    return sum;
}

static void dp_forces_note_founded(const struct dp *p, int q, int i, double x, double time) {
    peak_larger(fabs(x), time, &p->results->founded_peak[q][i], &p->results->founded_time[q][i]);
}

static void dp_forces_founded_motion(const struct dp *p, int q, int i, const struct motion *m) {
    const struct motion_pieces s = dp_motion_cut(m);
    for (int j = 1; j <= s.n; j++) {
        dp_forces_note_founded(p, q, i, s.d[j], p->now.time + s.x[j] * p->h);
    }
}

// Deformations and shears of the storeys of a building with a foundation: at the end of the step,
// and where they turn. Shears of storeys that yield are known at the end only.
static void dp_forces_founded(const struct dp *p, const struct building *g) {
    const double *const x[] = {p->now.u, p->next.u, p->now.v, p->next.v, p->now.a, p->next.a};
    const double *shear = p->system.part_shear + g->first;
    double end[6];
    for (int i = 0; i < g->n_floor; i++) {
        const struct foundation_row row = foundation_row(g, i);
        const struct motion deformation = dp_forces_sum(p, 3, row.dof, row.weight);
        dp_forces_founded_motion(p, 0, g->first + i, &deformation);
        if (!g->elastic) {
            dp_forces_note_founded(p, 1, g->first + i, shear[i] - shear[g->n_floor], p->next.time);
            continue;
        }
        for (int k = 0; k < 6; k++) {
            end[k] = dp_forces_founded_shear(p, g, x[k], i);
        }
        const struct motion m = {{end[0], end[1]}, {end[2], end[3]}, {end[4], end[5]}, p->h};
        dp_forces_founded_motion(p, 1, g->first + i, &m);
    }
}

void dp_forces_step(struct dp *p, bool within) {
    for (int k = 0; k < p->model->n_building; k++) {
        const struct building *g = &p->model->building[k];
        if (g->n_hinge > 0) {
            dp_forces_hinged(p, g);
        } else if (g->n_force > 0) {
            dp_forces_building(p, g, within);
        }
        if (g->fixed) {
            dp_forces_founded(p, g);
        }
    }
    dp_forces_columns(p);
}
