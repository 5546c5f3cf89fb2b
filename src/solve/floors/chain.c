// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/floors/chain.h"

#include "core/lanes.h"
#include "solve/floors/floor_terms.h"

// The compiler sees from the mask that there are no elements beyond whole lanes.
static inline int whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

LANES void chain_strain(const struct chain *c, const double *restrict u, double *restrict drift,
                        double *restrict shear) {
    const double *restrict k = c->stiffness;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        double d = u[i] - c->joint[i] * u[i - 1];
        drift[i] = d;
        shear[i] = k[i] * d;
    }
}

LANES void chain_try(const struct chain *c, double h, const double *restrict u,
                     const double *restrict v, const double *restrict a, double *restrict drift,
                     double *restrict shear) {
    const double *restrict k = c->stiffness, *restrict joint = c->joint;
    const double half = h * h / 2.0;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        const double under = TRIAL_U(u[i - 1], v[i - 1], a[i - 1], h, half);
        double d = TRIAL_U(u[i], v[i], a[i], h, half) - joint[i] * under;
        drift[i] = d;
        shear[i] = k[i] * d;
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
                          const double *restrict shear, double *restrict r) {
    const double *restrict joint = c->joint;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        r[i] = RESIDUAL(external[i], r[i], shear[i], joint[i + 1] * shear[i + 1]);
    }
}
