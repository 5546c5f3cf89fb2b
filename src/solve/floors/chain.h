// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for every floor in every step, one loop after the other over the flat arrays of
// struct chain. Arrays are those of core/lanes.h; none that is written is also read. Counts n of
// floors are rounded down to whole lanes.
#ifndef JOSTLE_CHAIN_H
#define JOSTLE_CHAIN_H

#include "core/lanes.h"
#include "jostle/analysis.h"

// The end of the step of n floors if their accelerations stayed:
//     u_t = u + h v + h^2 a / 2,   v_t = v + h a.
void chain_trial(int n, double h, const double *u, const double *v, const double *a, double *u_t,
                 double *v_t);

// Drifts of the storeys below each floor, shears of elastic storeys, and damping forces C v; 0
// where C is full.
void chain_forces(const struct chain *c, const double *u, const double *v, double *drift,
                  double *shear, double *damping);

// External forces -m base of the ground accelerations below each floor.
void chain_inertia(const struct chain *c, const double *base, double *external);

// r = external - m a - damping - shear below + shear above.
void chain_residual(const struct chain *c, const double *external, const double *a,
                    const double *damping, const double *shear, double *r);

// u = u_t + b q, v = v_t + g q, a = a_0 + q, of n floors. False: not all is finite.
bool chain_correct(int n, double b, double g, const double *q, const double *u_t, const double *v_t,
                   const double *a_0, double *u, double *v, double *a);

#endif
