// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/chain.h"

#include <float.h>
#include <math.h>

#include "core/arena.h"
#include "core/lanes.h"

double *chain_array(const struct model *m, struct arena *a) {
    // One zero behind the values stands for a wall.
    size_t n = (size_t)lanes_whole(m->n_dof + 1);
    double *x = arena_alloc(a, n + LANES_WIDTH, sizeof *x);
    return x ? x + LANES_WIDTH : NULL;
}

static void fill(struct chain *c, const struct model *m) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        for (int i = 0; i < g->n_floor; i++) {
            int j = g->first + i;
            c->mass[j] = g->mass[i];
            c->stiffness[j] = g->stiffness[i];
            c->joint[j] = i > 0 ? 1.0 : 0.0;
            if (!g->damping_full) {
                c->damping[j] = g->damping_diagonal[i];
                c->damping_below[j] = i > 0 ? g->damping_off[i - 1] : 0.0;
                c->damping_above[j] = i + 1 < g->n_floor ? g->damping_off[i] : 0.0;
            }
        }
    }
}

bool chain_alloc(struct chain *c, const struct model *m, struct arena *a) {
    c->n = lanes_whole(m->n_dof);
    double **const part[] = {&c->mass,          &c->stiffness, &c->joint,
                             &c->damping_below, &c->damping,   &c->damping_above};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        *part[i] = chain_array(m, a);
        if (!*part[i]) {
            return false;
        }
    }
    fill(c, m);
    return true;
}

// The compiler sees from the mask that there are no elements beyond whole lanes.
static inline int whole(int n) {
    return n & ~(LANES_WIDTH - 1);
}

LANES void chain_trial(const struct chain *c, double h, const double *restrict u,
                       const double *restrict v, const double *restrict a, double *restrict u_t,
                       double *restrict v_t) {
    double half = h * h / 2.0;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        u_t[i] = u[i] + (h * v[i] + half * a[i]);
        v_t[i] = v[i] + h * a[i];
    }
}

LANES void chain_drifts(const struct chain *c, const double *restrict u, double *restrict drift,
                        double *restrict shear) {
    const double *restrict joint = c->joint;
    const double *restrict k = c->stiffness;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        drift[i] = u[i] - joint[i] * u[i - 1];
        shear[i] = k[i] * drift[i];
    }
}

LANES void chain_damping(const struct chain *c, const double *restrict v, double *restrict force) {
    const double *restrict below = c->damping_below;
    const double *restrict own = c->damping;
    const double *restrict above = c->damping_above;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        force[i] = below[i] * v[i - 1] + own[i] * v[i] + above[i] * v[i + 1];
    }
}

LANES void chain_residual(const struct chain *c, const double *restrict external,
                          const double *restrict a, const double *restrict damping,
                          const double *restrict shear, double *restrict r) {
    const double *restrict joint = c->joint;
    const double *restrict mass = c->mass;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        r[i] = external[i] - mass[i] * a[i] - damping[i] - shear[i] + joint[i + 1] * shear[i + 1];
    }
}

LANES bool chain_correct(const struct chain *c, double b, double g, const double *restrict q,
                         const double *restrict u_t, const double *restrict v_t,
                         const double *restrict a_0, const double *restrict base,
                         double *restrict u, double *restrict v, double *restrict a,
                         double *restrict total) {
    long bad = 0;
    for (int i = 0, n = whole(c->n); i < n; i++) {
        u[i] = u_t[i] + b * q[i];
        v[i] = v_t[i] + g * q[i];
        a[i] = a_0[i] + q[i];
        total[i] = a[i] + base[i];
        double size = fabs(u[i]) + fabs(v[i]) + fabs(a[i]);
        bad |= !(size <= DBL_MAX);
    }
    return bad == 0;
}

LANES void chain_work(const struct chain *c, const double *restrict f0, const double *restrict f1,
                      const double *restrict u0, const double *restrict u1, double *restrict work) {
    for (int i = 0, n = whole(c->n); i < n; i++) {
        work[i] += (f0[i] + f1[i]) * (u1[i] - u0[i]);
    }
}

LANES bool chain_exceeds(const struct chain *c, const double *const x[CHAIN_PEAKS],
                         double *const peak[CHAIN_PEAKS]) {
    long above = 0;
    for (int q = 0; q < CHAIN_PEAKS; q++) {
        const double *restrict value = x[q];
        const double *restrict limit = peak[q];
        for (int i = 0, n = whole(c->n); i < n; i++) {
            above |= fabs(value[i]) > limit[i];
        }
    }
    return above != 0;
}
