// SPDX-License-Identifier: GPL-3.0-or-later
// One step in free flight where storeys follow straight lines, on which they stay: as in floors.c,
// with the shears of the lines for K u, over all floors at once.
#include <stdint.h>

#include "solve/floor_loops.h"

// Drifts and shears on the storeys' branches. Negative if a storey is beyond its own.
LANES_INLINE int64_t follow(const struct flight *f, const double *u, double *drift,
                             double *shear) {
    const struct chain *c = &f->model->chain;
    const double *back = f->back, *spring = f->spring, *rest = f->rest, *limit = f->limit;
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = floors_whole(c->n); i < n; i++) {
        double d = floor_drift(c, u, i);
        double force = spring[i] * (d - rest[i]);
        sign |= number_beyond(force, limit[i]);
        drift[i] = d;
        shear[i] = back[i] * d + force;
    }
    return sign;
}

LANES_INLINE void unbalance(const struct chain *c, double ground, const double *a,
                             const double *v, const double *shear, double *r) {
    LANES_LOOP
    for (int i = 0, n = floors_whole(c->n); i < n; i++) {
        double p = -c->mass[i] * ground;
        r[i] = floor_unbalanced(c, p, a, v, shear[i], shear[i + 1], i);
    }
}

LANES_INLINE void unbalance_under(const struct chain *c, const double *external, const double *a,
                                   const double *v, const double *shear, double *r) {
    LANES_LOOP
    for (int i = 0, n = floors_whole(c->n); i < n; i++) {
        r[i] = floor_unbalanced(c, external[i], a, v, shear[i], shear[i + 1], i);
    }
}

// Adds the works on storeys. Negative if a shear is greater than ever.
LANES_INLINE int64_t add_storey_works(const struct flight *f, const struct state *now,
                                      const struct state *next, double *work_2x) {
    const double *shear0 = now->shear, *shear = next->shear;
    const double *drift0 = now->drift, *drift = next->drift;
    const double *peak = f->results->peak[PEAK_SHEAR];
    int64_t sign = 0;
    LANES_LOOP
    for (int i = 0, n = floors_whole(f->model->chain.n); i < n; i++) {
        sign |= number_beyond(shear[i], peak[i]);
        work_2x[i] += (shear0[i] + shear[i]) * (drift[i] - drift0[i]);
    }
    return sign;
}

// The state `next`; false: a storey leaves its branch, or the state is not finite.
LANES_INLINE bool move(const struct flight *f, const struct state *now, struct state *next) {
    struct work *w = f->work;
    const struct chain *c = &f->model->chain;
    double *u = w->u_trial, *v = w->v_trial, *r = w->residual, *q = w->correction;
    floors_predict(c->n, w->h, now->u, now->v, now->a, u, v);
    if (follow(f, u, next->drift, next->shear) < 0) {
        return false;
    }
    if (f->uniform) {
        unbalance(c, next->ground_a[0], now->a, v, next->shear, r);
    } else {
        unbalance_under(c, next->external, now->a, v, next->shear, r);
    }
    effective_solve_row(w->effective, f->model->n_building, r, q);
    int64_t sign =
        floors_correct(c->n, w->b, w->g, q, u, v, now->a, next->u, next->v, next->a);
    return (sign | follow(f, next->u, next->drift, next->shear)) >= 0;
}

LANES bool flight_yielding(const struct flight *f, const struct state *now, struct state *next) {
    struct energy_account *e = f->energy;
    struct results *r = f->results;
    const int n = f->model->chain.n;
    if (!move(f, now, next)) {
        return false;
    }
    enum nearness near = floors_look(f, 0, f->n_group, next->u, next->ground_u);
    if (near == NEARNESS_CLOSED) {
        return false;
    }
    int64_t higher = floors_add_works(f->model, 0, n, e, r->peak, now, next);
    higher |= add_storey_works(f, now, next, e->storey_2x);
    if (higher < 0) {
        floors_raise(f->model, 0, n, r, next, next->shear);
    }
    flight_finish(f, now, next, near);
    return true;
}
