// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over floors of which steps are made, for functions compiled by LANES. Arrays are those
// of core/lanes.h, and n and `end` whole lanes.
#ifndef JOSTLE_FLOOR_LOOPS_H
#define JOSTLE_FLOOR_LOOPS_H

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "core/number.h"
#include "solve/chain_floor.h"
#include "solve/flight.h"

LANES_INLINE int floors_whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

LANES_INLINE void floors_predict(int n, double h, const double *u0, const double *v0, const double *a0,
                           double *u, double *v) {
    double half = h * h / 2.0;
    LANES_LOOP
    for (int i = 0; i < floors_whole(n); i++) {
        u[i] = u0[i] + (h * v0[i] + half * a0[i]);
        v[i] = v0[i] + h * a0[i];
    }
}

LANES_INLINE void floors_unbalance(const struct chain *c, double ground, const double *a, const double *u,
                             const double *v, double *r) {
    LANES_LOOP
    for (int i = 0, n = floors_whole(c->n); i < n; i++) {
        r[i] = floor_residual(c, -c->mass[i] * ground, a, u, v, i);
    }
}

LANES_INLINE void floors_unbalance_under(const struct chain *c, const double *external, const double *a,
                                   const double *u, const double *v, double *r) {
    LANES_LOOP
    for (int i = 0, n = floors_whole(c->n); i < n; i++) {
        r[i] = floor_residual(c, external[i], a, u, v, i);
    }
}

LANES_INLINE int64_t floors_correct(int n, double b, double g, const double *q, const double *u_t,
                              const double *v_t, const double *a0, double *u, double *v,
                              double *a) {
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0; i < floors_whole(n); i++) {
        u[i] = u_t[i] + b * q[i];
        v[i] = v_t[i] + g * q[i];
        a[i] = a0[i] + q[i];
        sign |= number_beyond(fabs(u[i]) + fabs(v[i]) + fabs(a[i]), DBL_MAX);
    }
    return sign;
}

#define FLOORS_BITS(x) ((lanes_wide_bits)(x))
// Negative where |x| > peak >= 0, as number_beyond.
#define FLOORS_BEYOND(x, peak) (FLOORS_BITS(peak) - (FLOORS_BITS(x) & INT64_MAX))

// Adds the works of the floors from `first` to `end` in whole lanes. Negative if a displacement,
// velocity, total acceleration or drift is greater than ever. The shear of an elastic storey is so
// only with its drift: k |drift| is rounded to no less for a greater drift.
LANES_INLINE int64_t floors_add_works(const struct model *m, int first, int end, struct energy_account *e,
                              double *const peak[PEAK_COUNT], const struct state *now,
                              const struct state *next) {
    const struct chain *c = &m->chain;
    const bool uniform = state_is_uniform(m);
    const double ground_2x = uniform ? now->ground_a[0] + next->ground_a[0] : 0.0;
    const lanes_wide ground = next->ground_a[0] - (lanes_wide){0.0};
    const double *u = next->u, *v = next->v, *a = next->a, *base = next->base;
    lanes_wide input = LANES_AT(e->input_2x, 0), damping = LANES_AT(e->damping_2x, 0);
    lanes_wide_bits sign = {0};
    for (int i = first; i < end; i += LANES_WIDTH) {
        floors_input(c, i, ground_2x, now->u, u, &input);
        floors_damped(c, i, now->u, u, now->v, v, &damping);
        lanes_wide total = LANES_AT(a, i) + (uniform ? ground : LANES_AT(base, i));
        lanes_wide drift = LANES_AT(u, i) - LANES_AT(c->joint, i) * LANES_AT(u, i - 1);
        sign |= FLOORS_BEYOND(LANES_AT(u, i), LANES_AT(peak[PEAK_DISPLACEMENT], i)) |
                FLOORS_BEYOND(LANES_AT(v, i), LANES_AT(peak[PEAK_VELOCITY], i)) |
                FLOORS_BEYOND(total, LANES_AT(peak[PEAK_ACCELERATION], i)) |
                FLOORS_BEYOND(drift, LANES_AT(peak[PEAK_DRIFT], i));
    }
    *(lanes_wide *)e->input_2x = input;
    *(lanes_wide *)e->damping_2x = damping;
    int64_t any = 0;
    for (int lane = 0; lane < LANES_WIDTH; lane++) {
        any |= sign[lane];
    }
    return any;
}

// Takes the floors from `first` to `end` into the peaks. `shear` (n_dof), NULL: all are elastic.
LANES_INLINE void floors_raise(const struct model *m, int first, int end, struct results *r,
                         const struct state *s, const double *shear) {
    const struct chain *c = &m->chain;
    double *const *peak = r->peak, *const *when = r->peak_time;
    double *peak_u = peak[PEAK_DISPLACEMENT], *peak_v = peak[PEAK_VELOCITY];
    double *peak_a = peak[PEAK_ACCELERATION];
    double *peak_d = peak[PEAK_DRIFT], *peak_s = peak[PEAK_SHEAR];
    double *when_u = when[PEAK_DISPLACEMENT], *when_v = when[PEAK_VELOCITY];
    double *when_a = when[PEAK_ACCELERATION];
    double *when_d = when[PEAK_DRIFT], *when_s = when[PEAK_SHEAR];
    const double *u = s->u, *v = s->v, *a = s->a, *base = s->base, *k = c->stiffness;
    const bool uniform = state_is_uniform(m);
    const double ground = s->ground_a[0], time = s->time;
    LANES_LOOP
    for (int i = first, n = first + floors_whole(end - first); i < n; i++) {
        double drift = floor_drift(c, u, i);
        peak_raise(u[i], time, &peak_u[i], &when_u[i]);
        peak_raise(v[i], time, &peak_v[i], &when_v[i]);
        peak_raise(a[i] + (uniform ? ground : base[i]), time, &peak_a[i], &when_a[i]);
        peak_raise(drift, time, &peak_d[i], &when_d[i]);
        peak_raise(shear ? shear[i] : k[i] * drift, time, &peak_s[i], &when_s[i]);
    }
}


// How near have the contacts of some groups come: closed, or nearer than ever?
LANES_INLINE enum nearness floors_look(const struct flight *f, int from, int to, const double *u,
                                 const double *ground) {
    const double *gap = f->gap + (ptrdiff_t)from * LANES_WIDTH;
    lanes_wide_bits closed = {0}, nearer = {0};
    for (const struct gap_group *g = f->group + from; g < f->group + to; g++, gap += LANES_WIDTH) {
        double apart = ground[g->ground[0]] - ground[g->ground[1]];
        lanes_wide delta =
            LANES_AT(u, g->dof[0]) - LANES_AT(u, g->dof[1]) - LANES_AT(gap, 0) + apart;
        closed |= FLOORS_BITS(0.0 - delta);
        nearer |= FLOORS_BITS(LANES_AT(f->results->deepest, g->contact) - delta);
    }
    int64_t any_closed = 0, any_nearer = 0;
    for (int lane = 0; lane < LANES_WIDTH; lane++) {
        any_closed |= closed[lane];
        any_nearer |= nearer[lane];
    }
    return any_closed < 0 ? NEARNESS_CLOSED : any_nearer < 0 ? NEARNESS_DEEPEST : NEARNESS_FAR;
}

#endif
