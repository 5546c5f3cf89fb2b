// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/floors/chain.h"

#include <float.h>
#include <math.h>

#include "core/lanes.h"
#include "solve/floors/floor_terms.h"

// The compiler sees from the mask that there are no elements beyond whole lanes.
static inline int whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

LANES void chain_trial(int n, double h, const double *restrict u, const double *restrict v,
                       const double *restrict a, double *restrict u_t, double *restrict v_t) {
    double half = h * h / 2.0;
    for (int i = 0, end = whole(n); i < end; i++) {
        u_t[i] = TRIAL_U(u[i], v[i], a[i], h, half);
        v_t[i] = TRIAL_V(v[i], a[i], h);
    }
}

LANES void chain_forces(const struct chain *c, const double *restrict u, const double *restrict v,
                        double *restrict drift, double *restrict shear, double *restrict damping) {
    const double *restrict k = c->stiffness;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        double d = u[i] - c->joint[i] * u[i - 1];
        drift[i] = d;
        shear[i] = k[i] * d;
        damping[i] = BANDS(c->damping_below[i], v[i - 1], c->damping[i], v[i], c->damping_above[i],
                           v[i + 1]);
    }
}

LANES void chain_inertia(const struct chain *c, const double *restrict base,
                         double *restrict external) {
    const double *restrict mass = c->mass;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        external[i] = -mass[i] * base[i];
    }
}

LANES void chain_residual(const struct chain *c, const double *restrict external,
                          const double *restrict a, const double *restrict damping,
                          const double *restrict shear, double *restrict r) {
    const double *restrict joint = c->joint;
    const double *restrict mass = c->mass;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        r[i] = RESIDUAL(external[i] - mass[i] * a[i], damping[i], shear[i],
                        joint[i + 1] * shear[i + 1]);
    }
}

LANES bool chain_correct(int n, double b, double g, const double *restrict q,
                         const double *restrict u_t, const double *restrict v_t,
                         const double *restrict a_0, double *restrict u, double *restrict v,
                         double *restrict a) {
    long bad = 0;
    for (int i = 0, end = whole(n); i < end; i++) {
        u[i] = END(u_t[i], b, q[i]);
        v[i] = END(v_t[i], g, q[i]);
        a[i] = a_0[i] + q[i];
        double size = fabs(u[i]) + fabs(v[i]) + fabs(a[i]);
        bad |= !(size <= DBL_MAX);
    }
    return bad == 0;
}
