// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method in free flight, where all is linear (K u stands for the shears of
// storeys on their branches):
//     u_t = u + h v + h^2 a / 2,   v_t = v + h a,
//     A q = external - M a - C v_t - K u_t,
//     u = u_t + beta h^2 q,   v = v_t + gamma h q,   a = a + q,
// as newmark.c does it, operation by operation. The works of external and damping forces and the
// tests for peaks and contacts run along.
#include <assert.h>
#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "core/lanes.h"
#include "core/number.h"
#include "solve/chain_floor.h"
#include "solve/flight.h"
#include "solve/newmark.h"

static inline int whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

static inline void shake(const struct chain *c, double ground, double *base, double *external) {
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        base[i] = c->floor[i] * ground;
        external[i] = -c->mass[i] * ground;
    }
}

static inline void predict(const struct chain *c, double h, const struct state *now, double *u,
                           double *v) {
    const double *u0 = now->u, *v0 = now->v, *a0 = now->a;
    double half = h * h / 2.0;
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        u[i] = u0[i] + (h * v0[i] + half * a0[i]);
        v[i] = v0[i] + h * a0[i];
    }
}

static inline void unbalance(const struct chain *c, const double *external, const double *a,
                             const double *u, const double *v, double *r) {
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        r[i] = floor_residual(c, external, a, u, v, i);
    }
}

// Drifts and shears on the storeys' branches. Negative if a storey is beyond its own.
static inline int64_t follow(const struct flight *f, const double *u, double *drift,
                             double *shear) {
    const struct chain *c = &f->model->chain;
    const double *back = f->back, *spring = f->spring, *rest = f->rest, *limit = f->limit;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        double d = floor_drift(c, u, i);
        double force = spring[i] * (d - rest[i]);
        sign |= number_beyond(force, limit[i]);
        drift[i] = d;
        shear[i] = back[i] * d + force;
    }
    return sign;
}

static inline void unbalance_of(const struct chain *c, const double *external, const double *a,
                                const double *v, const double *shear, double *r) {
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        r[i] = floor_unbalanced(c, external, a, v, shear[i], shear[i + 1], i);
    }
}

// q = A^-1 r for at most LANES_WIDTH floors.
static inline void multiply_low(const double *inverse, const double *r, double *q) {
    lanes_wide sum = {0.0};
    for (int i = 0; i < LANES_WIDTH; i++) {
        sum += r[i] * *(const lanes_wide *)(inverse + (ptrdiff_t)i * LANES_WIDTH);
    }
    *(lanes_wide *)q = sum;
}

// For at most twice as many: LANES_WIDTH columns, the first of which is column j.
static inline void multiply_columns(const double *inverse, int j, const double *r, double *q) {
    enum { STRIDE = 2 * LANES_WIDTH };
    const double *row = inverse + j;
    lanes first = {0.0}, second = {0.0};
    for (int i = 0; i < STRIDE; i++, row += STRIDE) {
        first += r[i] * *(const lanes *)row;
        second += r[i] * *(const lanes *)(row + LANES_VECTOR);
    }
    *(lanes *)(q + j) = first;
    *(lanes *)(q + j + LANES_VECTOR) = second;
}

// q = A^-1 r. Rows and columns beyond the inverse are 0, and what is written beyond q belongs to
// the next building.
static inline void multiply(const struct effective *e, const double *r, double *q) {
    static_assert(INVERSE_FLOORS_MAX <= 2 * LANES_WIDTH, "those are all the strides there are");
    static_assert(LANES_WIDTH == 2 * LANES_VECTOR, "there are two halves");
    if (e->stride == LANES_WIDTH) {
        multiply_low(e->inverse, r, q);
    } else {
        multiply_columns(e->inverse, 0, r, q);
        multiply_columns(e->inverse, LANES_WIDTH, r, q);
    }
}

// Solves for building k, or for the four from k on; returns how many.
static int solve_tall(struct work *w, int k) {
    const struct building *g = &w->model->building[k];
    int last = k + 4 <= w->model->n_building ? k + 3 : w->model->n_building - 1;
    int n = w->model->building[last].first + w->model->building[last].n_floor - g->first;
    memset(w->correction + g->first, 0, (size_t)n * sizeof *w->correction);
    return newmark_solve_from(w, k);
}

static inline void solve(struct work *w) {
    for (int k = 0, n = w->model->n_building; k < n;) {
        const struct effective *e = &w->effective[k];
        if (e->stride <= INVERSE_FLOORS_MAX) {
            multiply(e, w->residual + e->building->first, w->correction + e->building->first);
            k++;
        } else {
            k += solve_tall(w, k);
        }
    }
}

// Negative if a displacement, velocity or total acceleration is greater than ever.
static inline int64_t correct(const struct flight *f, const struct state *now, const double *base,
                              double *u, double *v, double *a) {
    const struct work *w = f->work;
    double *const *peak = f->results->peak;
    const double *q = w->correction, *a0 = now->a;
    const double *peak_u = peak[PEAK_DISPLACEMENT], *peak_v = peak[PEAK_VELOCITY];
    const double *peak_a = peak[PEAK_ACCELERATION];
    double b = w->b, g = w->g;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = whole(w->model->chain.n); i < n; i++) {
        u[i] = u[i] + b * q[i];
        v[i] = v[i] + g * q[i];
        a[i] = a0[i] + q[i];
        sign |= number_beyond(u[i], peak_u[i]) | number_beyond(v[i], peak_v[i]) |
                number_beyond(a[i] + base[i], peak_a[i]);
    }
    return sign;
}

// Is a contact closed, or has one come nearer than ever?
static inline bool is_near(const struct flight *f, const double *u, const double *ground) {
    const double *gap = f->gap;
    lanes_bits sign = {0};
    for (const struct gap_group *g = f->group; g < f->group + f->n_group; g++) {
        const double *left = u + g->dof[0], *right = u + g->dof[1];
        const double *deepest = f->work->gaps.nearest + g->contact;
        double apart = ground[g->ground[0]] - ground[g->ground[1]];
        for (int i = 0; i < LANES_WIDTH; i += LANES_VECTOR, gap += LANES_VECTOR) {
            lanes delta = *(const lanes *)(left + i) - *(const lanes *)(right + i) -
                          *(const lanes *)gap + apart;
            sign |= (lanes_bits)(0.0 - delta) | (lanes_bits)(*(const lanes *)(deepest + i) - delta);
        }
    }
    return (sign[0] | sign[1] | sign[2] | sign[3]) < 0;
}

// Negative if a drift is greater than ever. The shear of an elastic storey is so only with its
// drift: k |drift| is rounded to no less for a greater drift.
static inline int64_t account(const struct flight *f, const struct state *now,
                              const struct state *next) {
    const struct chain *c = &f->model->chain;
    struct energy_account *a = f->energy;
    const double *u = next->u, *peak = f->results->peak[PEAK_DRIFT];
    const double ground_2x = f->uniform ? now->ground_a[0] + next->ground_a[0] : 0.0;
    lanes_wide input = LANES_AT(a->input_2x, 0), damping = LANES_AT(a->damping_2x, 0);
    for (int i = 0; i < c->n; i += LANES_WIDTH) {
        floors_input(c, i, ground_2x, now->u, u, &input);
        floors_damped(c, i, now->u, u, now->v, next->v, &damping);
    }
    *(lanes_wide *)a->input_2x = input;
    *(lanes_wide *)a->damping_2x = damping;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        sign |= number_beyond(floor_drift(c, u, i), peak[i]);
    }
    return sign;
}

// Negative if a shear is greater than ever.
static inline int64_t account_storeys(const struct flight *f, const struct state *now,
                                      const struct state *next, double *work_2x) {
    const double *shear0 = now->shear, *shear = next->shear;
    const double *drift0 = now->drift, *drift = next->drift;
    const double *peak = f->results->peak[PEAK_SHEAR];
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = whole(f->model->chain.n); i < n; i++) {
        sign |= number_beyond(shear[i], peak[i]);
        work_2x[i] += (shear0[i] + shear[i]) * (drift[i] - drift0[i]);
    }
    return sign;
}

static inline void begin(const struct flight *f, const struct state *now, struct state *next,
                         double ground) {
    const struct chain *c = &f->model->chain;
    predict(c, f->work->h, now, next->u, next->v);
    if (f->uniform) {
        shake(c, ground, next->base, next->external);
    }
}

// `sign` is what `correct` has found.
static inline unsigned end(const struct flight *f, const struct state *now, struct state *next,
                           int64_t sign) {
    if (is_near(f, next->u, next->ground_u) && flight_near(f, next) == FLIGHT_ENDS) {
        return FLIGHT_ENDS;
    }
    sign |= account(f, now, next);
    if (!f->uniform) {
        energy_input(f->energy, f->model, now, next);
    }
    return sign < 0 ? FLIGHT_PEAK : 0;
}

LANES unsigned flight_step(const struct flight *f, const struct state *now, struct state *next,
                           double ground) {
    struct work *w = f->work;
    begin(f, now, next, ground);
    unbalance(&f->model->chain, next->external, now->a, next->u, next->v, w->residual);
    solve(w);
    return end(f, now, next, correct(f, now, next->base, next->u, next->v, next->a));
}

LANES unsigned flight_step_yielding(const struct flight *f, const struct state *now,
                                    struct state *next, double ground) {
    struct work *w = f->work;
    begin(f, now, next, ground);
    if (follow(f, next->u, next->drift, next->shear) < 0) {
        return FLIGHT_ENDS;
    }
    unbalance_of(&f->model->chain, next->external, now->a, next->v, next->shear, w->residual);
    solve(w);
    int64_t sign = correct(f, now, next->base, next->u, next->v, next->a);
    if (follow(f, next->u, next->drift, next->shear) < 0) {
        return FLIGHT_ENDS;
    }
    unsigned event = end(f, now, next, sign);
    bool goes_on = event != FLIGHT_ENDS;
    bool peak = goes_on && account_storeys(f, now, next, f->energy->storey_2x) < 0;
    return peak ? FLIGHT_PEAK : event;
}

LANES unsigned flight_peaks(const struct flight *f, const struct state *s) {
    const struct chain *c = &f->model->chain;
    double *const *peak = f->results->peak, *const *when = f->results->peak_time;
    double *peak_u = peak[PEAK_DISPLACEMENT], *peak_v = peak[PEAK_VELOCITY];
    double *peak_a = peak[PEAK_ACCELERATION];
    double *peak_d = peak[PEAK_DRIFT], *peak_s = peak[PEAK_SHEAR];
    double *when_u = when[PEAK_DISPLACEMENT], *when_v = when[PEAK_VELOCITY];
    double *when_a = when[PEAK_ACCELERATION];
    double *when_d = when[PEAK_DRIFT], *when_s = when[PEAK_SHEAR];
    const double *u = s->u, *v = s->v, *a = s->a, *base = s->base;
    const double *back = f->back, *spring = f->spring, *rest = f->rest;
    double time = s->time;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        double drift = floor_drift(c, u, i);
        sign |= number_beyond(fabs(u[i]) + fabs(v[i]) + fabs(a[i]), DBL_MAX);
        peak_raise(u[i], time, &peak_u[i], &when_u[i]);
        peak_raise(v[i], time, &peak_v[i], &when_v[i]);
        peak_raise(a[i] + base[i], time, &peak_a[i], &when_a[i]);
        peak_raise(drift, time, &peak_d[i], &when_d[i]);
        peak_raise(back[i] * drift + spring[i] * (drift - rest[i]), time, &peak_s[i], &when_s[i]);
    }
    return sign < 0 ? FLIGHT_ENDS : 0;
}
