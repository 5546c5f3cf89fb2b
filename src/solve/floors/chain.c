// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/floors/chain.h"

#include <assert.h>
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

LANES void chain_work(const struct chain *c, const double *restrict f0, const double *restrict f1,
                      const double *restrict u0, const double *restrict u1,
                      double work[LANES_WIDTH]) {
    lanes_wide sum = LANES_AT(work, 0);
    for (int i = 0; i < c->n; i += LANES_WIDTH) {
        sum += (LANES_AT(f0, i) + LANES_AT(f1, i)) * (LANES_AT(u1, i) - LANES_AT(u0, i));
    }
    *(lanes_wide *)work = sum;
}

LANES void chain_work_of_ground(const struct chain *c, double ground_2x, const double *restrict u0,
                                const double *restrict u1, double work[LANES_WIDTH]) {
    lanes_wide sum = LANES_AT(work, 0);
    for (int i = 0; i < c->n; i += LANES_WIDTH) {
        sum -= WORK_OF_GROUND(ground_2x, LANES_AT(c->mass, i), LANES_AT(u1, i) - LANES_AT(u0, i));
    }
    *(lanes_wide *)work = sum;
}

LANES void chain_work_of_damping(const struct chain *c, const double *restrict u0,
                                 const double *restrict u1, const double *restrict v0,
                                 const double *restrict v1, double work[LANES_WIDTH]) {
    lanes_wide sum = LANES_AT(work, 0);
    for (int i = 0; i < c->n; i += LANES_WIDTH) {
        const lanes_wide below = LANES_AT(v0, i - 1) + LANES_AT(v1, i - 1);
        const lanes_wide own = LANES_AT(v0, i) + LANES_AT(v1, i);
        const lanes_wide above = LANES_AT(v0, i + 1) + LANES_AT(v1, i + 1);
        sum += WORK_OF_DAMPING(LANES_AT(u1, i) - LANES_AT(u0, i),
                               BANDS(LANES_AT(c->damping_below, i), below, LANES_AT(c->damping, i),
                                     own, LANES_AT(c->damping_below, i + 1), above));
    }
    *(lanes_wide *)work = sum;
}

LANES void chain_storey_works(const struct chain *c, const double *restrict f0,
                              const double *restrict f1, const double *restrict d0,
                              const double *restrict d1, double *restrict work) {
    for (int i = 0, n = whole(c->n); i < n; i++) {
        work[i] += (f0[i] + f1[i]) * (d1[i] - d0[i]);
    }
}

LANES bool chain_exceeds(int first, int n, const double *const x[PEAK_COUNT],
                         double *const peak[PEAK_COUNT]) {
    const double *restrict x0 = x[0], *restrict x1 = x[1], *restrict x2 = x[2];
    const double *restrict x3 = x[3], *restrict x4 = x[4];
    const double *restrict p0 = peak[0], *restrict p1 = peak[1], *restrict p2 = peak[2];
    const double *restrict p3 = peak[3], *restrict p4 = peak[4];
    static_assert(PEAK_COUNT == 5, "all peaks are looked at");
    long above = 0;
    for (int i = first, end = first + whole(n); i < end; i++) {
        above |= (fabs(x0[i]) > p0[i]) | (fabs(x1[i]) > p1[i]) | (fabs(x2[i]) > p2[i]) |
                 (fabs(x3[i]) > p3[i]) | (fabs(x4[i]) > p4[i]);
    }
    return above != 0;
}
