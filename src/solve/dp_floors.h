// SPDX-License-Identifier: GPL-3.0-or-later
// The right-hand side for every floor, for loops that are compiled in lanes.
#ifndef JOSTLE_DP_FLOORS_H
#define JOSTLE_DP_FLOORS_H

#include <assert.h>

#include "core/lanes.h"
#include "solve/dp_system.h"

LANES_INLINE double dp_floors_sum(const double *x, int n) {
    static_assert(LANES_WIDTH == 2 * LANES_VECTOR && LANES_VECTOR == 4, "all of them are summed");
    const lanes *part = (const lanes *)x;
    lanes even = {0.0}, odd = {0.0};
    for (int j = 0, end = lanes_whole(n) / LANES_VECTOR; j < end; j += 2) {
        even += part[j];
        odd += part[j + 1];
    }
    even += odd;
    return (even[0] + even[1]) + (even[2] + even[3]);
}

// Accelerations of all floors from r->u and r->v without links, loads and what is special, under
// the ground acceleration `ground`, and what the ground and the dampers do.
LANES_INLINE void dp_floors_rates(const struct dp_system *s, double ground, struct dp_rates *r) {
    const double *k_below = s->row[DP_K_BELOW], *c_below = s->row[DP_C_BELOW];
    const double *k_own = s->row[DP_K_OWN], *c_own = s->row[DP_C_OWN];
    const double *k_above = s->row[DP_K_ABOVE], *c_above = s->row[DP_C_ABOVE];
    const double *constant = s->row[DP_CONSTANT], *share = s->row[DP_GROUND];
    const double *mass = s->model->chain.mass;
    const double *u = r->u, *v = r->v;
    double *a = r->a, *carried = s->carried, *damped = s->damped;
    int n = s->model->n_dof;
    LANES_LOOP
    for (int i = 0, end = lanes_whole(n); i < end; i++) {
        double spring = k_below[i] * u[i - 1] + k_own[i] * u[i] + k_above[i] * u[i + 1];
        double damping = c_below[i] * v[i - 1] + c_own[i] * v[i] + c_above[i] * v[i + 1];
        double momentum = mass[i] * v[i];
        carried[i] = share[i] * momentum;
        damped[i] = damping * momentum;
        a[i] = constant[i] - ground * share[i] - (spring + damping);
    }
    r->input = -ground * dp_floors_sum(carried, n);
    r->damping = dp_floors_sum(damped, n);
}

#endif
