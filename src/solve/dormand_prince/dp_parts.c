// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dormand_prince/dp_parts.h"

#include <math.h>
#include <string.h>

#include "model/parts.h"
#include "solve/dormand_prince/dp_motion.h"

static void dp_find_drifts(const struct building *g, const double *x, double *drift) {
    for (int i = 0; i < g->n_floor; i++) {
        drift[i] = x[g->first + i] - (i > 0 ? x[g->first + i - 1] : 0.0);
    }
}

// Sets s->part_shear of the building at displacements u and velocities v (n_dof).
static const double *dp_shears(const struct dp_system *s, const double *history,
                               const struct building *g, const double *u, const double *v,
                               double *after) {
    double *drift = s->part_drift + g->first, *rate = s->part_rate + g->first;
    double *shear = s->part_shear + g->first;
    dp_find_drifts(g, u, drift);
    dp_find_drifts(g, v, rate);
    memset(shear, 0, (size_t)g->n_floor * sizeof *shear);
    parts_respond(g, history, drift, rate, &(struct part_sums){.shear = shear}, after);
    return shear;
}

// Power of the parts and of elastic storeys beside them; that of other storeys is taken with them.
static double dp_power(const struct dp_system *s, const struct building *g) {
    double sum = 0.0;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        const bool elastic = s->model->storey[i].law->n_history == 0;
        const double spring = elastic ? g->spring[i - g->first] : 0.0;
        sum += (s->part_shear[i] + spring * s->part_drift[i]) * s->part_rate[i];
    }
    return sum;
}

void dp_parts_add(const struct dp_system *s, const struct state *now, const struct building *g,
                  struct dp_rates *r) {
    const double *shear = dp_shears(s, now->storey_history, g, r->u, r->v, NULL);
    double *a = r->a + g->first;
    for (int i = 0; i < g->n_floor; i++) {
        const double above = i + 1 < g->n_floor ? shear[i + 1] : 0.0;
        a[i] += (above - shear[i]) * s->mobility[g->first + i];
    }
    r->storey += g->elastic ? 0.0 : dp_power(s, g);
}

void dp_parts_commit(const struct dp_system *s, struct state *now) {
    for (int k = 0; k < s->model->n_building; k++) {
        const struct building *g = &s->model->building[k];
        if (!g->elastic && g->n_part > 0) {
            dp_shears(s, now->storey_history, g, now->u, now->v, now->storey_history);
        }
    }
}

// Difference of the shears at the end of the step with the histories that its way there commits and
// with those of its start, as drifts over that allowed.
static double dp_way_error(const struct dp *p, int k) {
    enum { POINTS = 4 };
    const struct dp_system *s = &p->system;
    const struct building *g = &p->model->building[k];
    struct dp_rates *r = p->stage[1];  // its weight in the step is 0
    const double allowed = p->model->control.tolerance * p->scales.most_u;
    double largest = 0.0;
    for (int i = 1; i < POINTS; i++) {
        dp_motion_between(p, (double)i / POINTS, k);
        dp_shears(s, i == 1 ? p->now.storey_history : s->part_history, g, r->u, r->v,
                  s->part_history);
    }
    const double *shear = dp_shears(s, p->now.storey_history, g, p->next.u, p->next.v, NULL);
    double *kept = r->a + g->first;
    memcpy(kept, shear, (size_t)g->n_floor * sizeof *kept);
    dp_shears(s, s->part_history, g, p->next.u, p->next.v, NULL);
    for (int i = 0; i < g->n_floor; i++) {
        const double change = fabs(shear[i] - kept[i]);
        largest = change > 0.0 ? fmax(largest, change / (g->stiffness[i] * allowed)) : largest;
    }
    return largest;
}

static bool dp_remembers(const struct building *g) {
    bool any = false;
    for (int i = 0; i < g->n_part; i++) {
        any |= g->part[i].n_history > 0;
    }
    return any;
}

double dp_parts_error(const struct dp *p) {
    double largest = 0.0;
    for (int k = 0; k < p->model->n_building; k++) {
        if (dp_remembers(&p->model->building[k])) {
            largest = fmax(largest, dp_way_error(p, k));
        }
    }
    return largest;
}

// The storey shear below degree of freedom i where all is linear and x are displacements; its rate
// where they are velocities.
static double dp_linear_shear(const struct building *g, const double *x, int i) {
    const int n = g->n_floor, row = i - g->first;
    double sum = 0.0;
    for (int j = 0; j < n; j++) {
        const double drift = x[g->first + j] - (j > 0 ? x[g->first + j - 1] : 0.0);
        sum += (g->part_stiffness[row * n + j] + (j == row ? g->spring[row] : 0.0)) * drift;
    }
    return sum;
}

static void dp_note(struct dp *p, int i, double shear, double time) {
    if (fabs(shear) > p->results->peak[PEAK_SHEAR][i]) {
        p->results->peak[PEAK_SHEAR][i] = fabs(shear);
        p->results->peak_time[PEAK_SHEAR][i] = time;
    }
}

static void dp_elastic_peak(struct dp *p, const struct building *g, int i) {
    const struct state *now = &p->now, *next = &p->next;
    const struct motion m = {
        .d = {dp_linear_shear(g, now->u, i), dp_linear_shear(g, next->u, i)},
        .v = {dp_linear_shear(g, now->v, i), dp_linear_shear(g, next->v, i)},
        .a = {dp_linear_shear(g, now->a, i), dp_linear_shear(g, next->a, i)},
        .h = p->h,
    };
    if (m.v[0] * m.v[1] < 0.0) {
        const struct polynomial shear = dp_motion_path(&m);
        double x[TURNS_MAX];
        const int n = dp_motion_turns(&m, x);
        for (int j = 0; j < n; j++) {
            dp_note(p, i, dp_motion_value(&shear, x[j]), now->time + x[j] * p->h);
        }
    }
    dp_note(p, i, m.d[1], next->time);
}

void dp_parts_peaks(struct dp *p) {
    const struct dp_system *s = &p->system;
    for (int k = 0; k < p->model->n_building; k++) {
        const struct building *g = &p->model->building[k];
        if (g->n_part > 0 && !g->elastic) {
            dp_shears(s, p->now.storey_history, g, p->next.u, p->next.v, NULL);
        }
        for (int i = g->first; g->n_part > 0 && i < g->first + g->n_floor; i++) {
            if (g->elastic) {
                dp_elastic_peak(p, g, i);
            } else {
                const double storey = dp_system_shear(s, &p->now, i, p->next.drift[i]);
                dp_note(p, i, storey + s->part_shear[i], p->next.time);
            }
        }
    }
}
