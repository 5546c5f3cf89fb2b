// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dormand_prince/dp_motion.h"

#include <math.h>

#include "core/lanes.h"

static void motion_accelerations(const struct dp *p, const struct link *l, struct motion *m) {
    m->a[0] = dp_system_across(l, p->model, p->now.a, p->now.ground_a);
    m->a[1] = dp_system_across(l, p->model, p->next.a, p->next.ground_a);
}

struct motion dp_motion_link(const struct dp *p, int k) {
    struct motion m = {
        .d = {p->now.delta[k], p->next.delta[k]},
        .v = {p->rate[0][k], p->rate[1][k]},
        .h = p->h,
    };
    motion_accelerations(p, &p->model->link[k], &m);
    return m;
}

struct motion dp_motion_floor(const struct dp *p, int i) {
    return (struct motion){
        .d = {p->now.u[i], p->next.u[i]},
        .v = {p->now.v[i], p->next.v[i]},
        .a = {p->now.a[i], p->next.a[i]},
        .h = p->h,
    };
}

// The difference of x at floor i and at the one below.
static double across(const struct dp *p, const double *x, int i) {
    int below = p->system.below[i];
    return below < 0 ? x[i] : x[i] - x[below];
}

struct motion dp_motion_storey(const struct dp *p, int i) {
    return (struct motion){
        .d = {across(p, p->now.u, i), across(p, p->next.u, i)},
        .v = {across(p, p->now.v, i), across(p, p->next.v, i)},
        .a = {across(p, p->now.a, i), across(p, p->next.a, i)},
        .h = p->h,
    };
}

double dp_motion_noise(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    double size = fabs(l->gap) + p->scales.most_u;  // bodies at rest move by rounding
    for (int i = 0; i < 2; i++) {
        size +=
            l->dof[i] == WALL ? 0.0 : fmax(fabs(p->now.u[l->dof[i]]), fabs(p->next.u[l->dof[i]]));
        if (l->moving_ground) {
            size += fabs(p->now.ground_u[p->model->building[l->building[i]].ground]);
        }
    }
    return SCALE_ROUNDING * size;
}

// A motion that goes beyond both its ends does so by a fraction of its way at the larger rate.
LANES void dp_motion_reach(struct dp *p) {
    const double *restrict d0 = p->now.delta, *restrict d1 = p->next.delta;
    const double *restrict v0 = p->rate[0], *restrict v1 = p->rate[1];
    const double *restrict deepest = p->results->deepest;
    double *restrict reach = p->reach;
    double h = p->h;
    int64_t closes = 0;
    int64_t deepens = 0;
    for (int i = 0, n = p->model->n_contact; i < n; i++) {
        double d = d0[i] > d1[i] ? d0[i] : d1[i];
        double v = fabs(v0[i]) > fabs(v1[i]) ? fabs(v0[i]) : fabs(v1[i]);
        double most = d + h * v;
        reach[i] = most;
        closes |= most > 0.0;
        deepens |= most > deepest[i];
    }
    p->closes = closes != 0;
    p->deepens = deepens != 0;
}

enum { ENDS = 6 };

// u and v as sums over what is known at both ends.
LANES static void sum_ends(int n, const double *const *of, const double *to_u, const double *to_v,
                           double *restrict u, double *restrict v) {
    for (int i = 0, end = lanes_whole(n); i < end; i++) {
        u[i] = v[i] = 0.0;
        for (int q = 0; q < ENDS; q++) {
            u[i] += to_u[q] * of[q][i];
            v[i] += to_v[q] * of[q][i];
        }
    }
}

// By the Hermite polynomial of degree 5 and its slope.
void dp_motion_between(const struct dp *p, double x, double *u, double *v) {
    const struct state *now = &p->now;
    const struct state *next = &p->next;
    double h = p->h;
    double y = 1.0 - x;
    double x2 = x * x;
    double y2 = y * y;
    double rise = x2 * x * (10.0 + x * (6.0 * x - 15.0));
    double slope = 30.0 * x2 * y2 / h;
    const double *const of[ENDS] = {now->u, now->v, now->a, next->u, next->v, next->a};
    const double to_u[ENDS] = {
        1.0 - rise, h * x * y2 * y * (1.0 + 3.0 * x),  h * h * x2 * y2 * y / 2.0,
        rise,       -h * x2 * x * y * (1.0 + 3.0 * y), h * h * x2 * x * y2 / 2.0};
    const double to_v[ENDS] = {
        -slope, y2 * (1.0 + x * (2.0 - 15.0 * x)), h * x * y2 * (2.0 - 5.0 * x) / 2.0,
        slope,  x2 * (1.0 + y * (2.0 - 15.0 * y)), -h * x2 * y * (2.0 - 5.0 * y) / 2.0};
    sum_ends(p->model->n_dof, of, to_u, to_v, u, v);
}

// The motion of n floors from `first` on at place x, into the second stage: its weight in the works
// is 0, so it is free between steps.
static void interpolate(struct dp *p, double x, int first, int n) {
    for (int i = first; i < first + n; i++) {
        struct motion m = dp_motion_floor(p, i);
        struct polynomial u = hermite_position(&m);
        p->stage[1]->u[i] = hermite_value(&u, x);
        p->stage[1]->v[i] = hermite_slope(&u, x) / p->h;
    }
}

double dp_motion_acceleration(struct dp *p, double x, int i) {
    const struct model *m = p->model;
    const struct building *g = &m->building[p->system.building[i]];
    bool roof = i + 1 == g->first + g->n_floor;
    if (g->damping_full) {
        interpolate(p, x, g->first, g->n_floor);
    } else {
        interpolate(p, x, i > g->first ? i - 1 : i, 1 + (i > g->first) + !roof);
    }
    for (int n = 0; n < p->now.n_live; n++) {
        const int *dof = m->link[p->now.live[n]].dof;
        if ((dof[0] == i || dof[1] == i) && dof[0] != WALL && dof[1] != WALL) {
            interpolate(p, x, dof[0] == i ? dof[1] : dof[0], 1);
        }
    }
    return dp_rates_acceleration(&p->system, &p->now, p->now.time + x * p->h, p->stage[1], i);
}
