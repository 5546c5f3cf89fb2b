// SPDX-License-Identifier: GPL-3.0-or-later
// What one floor of struct chain sees: the terms of the equations of motion, for the loops of
// chain.c and floor_loops.h, which so have the same bits.
#ifndef JOSTLE_CHAIN_FLOOR_H
#define JOSTLE_CHAIN_FLOOR_H

#include "core/lanes.h"
#include "jostle/model.h"

LANES_INLINE double floor_drift(const struct chain *c, const double *u, int i) {
    return u[i] - c->joint[i] * u[i - 1];
}

// Row i of C v.
LANES_INLINE double floor_damping(const struct chain *c, const double *v, int i) {
    return c->damping_below[i] * v[i - 1] + c->damping[i] * v[i] + c->damping_above[i] * v[i + 1];
}

// Twice the work of the ground on LANES_WIDTH floors from i on, while u0 becomes u1 under ground
// accelerations whose sum is ground_2x.
LANES_INLINE void floors_input(const struct chain *c, int i, double ground_2x, const double *u0,
                               const double *u1, lanes_wide *work) {
    *work -= ground_2x * (LANES_AT(c->mass, i) * (LANES_AT(u1, i) - LANES_AT(u0, i)));
}

// The same of damping; v0 + v1 are twice the mean velocities.
LANES_INLINE void floors_damped(const struct chain *c, int i, const double *u0, const double *u1,
                                const double *v0, const double *v1, lanes_wide *work) {
    lanes_wide below = LANES_AT(v0, i - 1) + LANES_AT(v1, i - 1);
    lanes_wide own = LANES_AT(v0, i) + LANES_AT(v1, i);
    lanes_wide above = LANES_AT(v0, i + 1) + LANES_AT(v1, i + 1);
    *work += (LANES_AT(u1, i) - LANES_AT(u0, i)) *
             (LANES_AT(c->damping_below, i) * below + LANES_AT(c->damping, i) * own +
              LANES_AT(c->damping_below, i + 1) * above);
}

#endif
