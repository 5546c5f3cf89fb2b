// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method in free flight, where all is linear:
//     u_t = u + h v + h^2 a / 2,   v_t = v + h a,
//     A q = external - M a - C v_t - K u_t,
//     u = u_t + beta h^2 q,   v = v_t + gamma h q,   a = a + q,
// as newmark.c does it, operation by operation. The works of external and damping forces and the
// tests for peaks and contacts run along.
//
// |x| > p is tested by the sign of bits(p) - bits(|x|): numbers that are not negative stand in the
// order of their bits, and what is not a number stands above all.
#include <stdint.h>
#include <string.h>

#include "core/lanes.h"
#include "solve/chain_floor.h"
#include "solve/flight.h"
#include "solve/newmark.h"
#include "solve/product.h"

static inline int whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

static inline int64_t bits(double x) {
    int64_t b;
    memcpy(&b, &x, sizeof b);
    return b;
}

// Negative if |x| > peak.
static inline int64_t beyond(double x, double peak) {
    return bits(peak) - (bits(x) & INT64_MAX);
}

static inline void predict(const struct chain *c, double h, const struct state *now,
                           double *restrict u, double *restrict v) {
    const double *u0 = now->u, *v0 = now->v, *a0 = now->a;
    double half = h * h / 2.0;
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        u[i] = u0[i] + (h * v0[i] + half * a0[i]);
        v[i] = v0[i] + h * a0[i];
    }
}

static inline void unbalance(const struct chain *c, const double *external, const double *a,
                             const double *u, const double *v, double *restrict r) {
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        r[i] = floor_residual(c, external, a, u, v, i);
    }
}

// Negative if a displacement, velocity or total acceleration is greater than ever.
static inline int64_t correct(const struct work *w, const struct state *now, const double *base,
                              double *const peak[PEAK_COUNT], double *restrict u,
                              double *restrict v, double *restrict a) {
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
        sign |=
            beyond(u[i], peak_u[i]) | beyond(v[i], peak_v[i]) | beyond(a[i] + base[i], peak_a[i]);
    }
    return sign;
}

// Is a contact closed? *sign becomes negative if one has come nearer than ever.
static inline bool meets(const struct flight *f, const double *u, const double *ground,
                         int64_t *sign) {
    const double *gap = f->gap;
    lanes_bits closed = {0}, nearer = {0};
    for (const struct gap_group *g = f->group; g < f->group + f->n_group; g++) {
        const double *left = u + g->dof[0], *right = u + g->dof[1];
        const double *deepest = f->results->deepest + g->contact;
        double apart = ground[g->ground[0]] - ground[g->ground[1]];
        for (int i = 0; i < LANES_WIDTH; i += LANES_VECTOR, gap += LANES_VECTOR) {
            lanes delta = *(const lanes *)(left + i) - *(const lanes *)(right + i) -
                          *(const lanes *)gap + apart;
            closed |= (lanes_bits)(0.0 - delta);
            nearer |= (lanes_bits)(*(const lanes *)(deepest + i) - delta);
        }
    }
    *sign |= nearer[0] | nearer[1] | nearer[2] | nearer[3];
    return (closed[0] | closed[1] | closed[2] | closed[3]) < 0;
}

// Negative if a drift is greater than ever. So is the shear then, or it is not: k |drift| rounds to
// no less for a greater drift.
static inline int64_t account(const struct flight *f, const struct state *now,
                              const struct state *next, double *restrict damping,
                              double *restrict input_2x, double *restrict damping_2x) {
    const struct chain *c = &f->model->chain;
    const double *u0 = now->u, *u = next->u, *v = next->v;
    const double *damping0 = now->damping_force;
    const double *external0 = now->external, *external = next->external;
    const double *peak = f->results->peak[PEAK_DRIFT];
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = whole(c->n); i < n; i++) {
        sign |= beyond(floor_drift(c, u, i), peak[i]);
        double force = floor_damping(c, v, i);
        double du = u[i] - u0[i];
        input_2x[i] += (external0[i] + external[i]) * du;
        damping_2x[i] += (damping0[i] + force) * du;
        damping[i] = force;
    }
    return sign;
}

// q = A^-1 r of building k, or of the four from k on; returns how many.
static inline int solve(struct work *w, int k) {
    const struct effective *e = &w->effective[k];
    int n = e->building->n_floor, first = e->building->first;
    double *q = w->correction + first;
    if (!effective_has_inverse(e)) {
        const struct building *last = &w->model->building[w->model->n_building - 1];
        last = last < e->building + 3 ? last : e->building + 3;
        memset(q, 0, (size_t)(last->first + last->n_floor - first) * sizeof *q);
        return newmark_solve_from(w, k);
    }
    for (int j = 0; j < n; j += LANES_WIDTH) {  // what goes beyond n is of the next building
        product_of_columns(e->inverse + j, e->stride, w->residual + first, n, (lanes *)(q + j));
    }
    return 1;
}

LANES enum flight_outcome flight_step(const struct flight *f, const struct state *now,
                                      struct state *next) {
    struct work *w = f->work;
    const struct chain *c = &f->model->chain;
    predict(c, w->h, now, next->u, next->v);
    unbalance(c, next->external, now->a, next->u, next->v, w->residual);
    for (int k = 0; k < f->model->n_building;) {
        k += solve(w, k);
    }
    int64_t sign = correct(w, now, next->base, f->results->peak, next->u, next->v, next->a);
    if (meets(f, next->u, next->ground_u, &sign)) {
        return FLIGHT_MEETS;
    }
    sign |= account(f, now, next, next->damping_force, f->energy->input_2x, f->energy->damping_2x);
    return sign < 0 ? FLIGHT_PEAK : FLIGHT_GOES_ON;
}
