// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for every floor in every step, one loop after the other over the flat arrays of
// struct chain. Arrays are those of core/lanes.h; none that is written is also read. Counts n of
// floors are rounded down to whole lanes.
#ifndef JOSTLE_CHAIN_H
#define JOSTLE_CHAIN_H

#include "core/lanes.h"
#include "jostle/analysis.h"

// Drifts of the storeys below each floor, shears of elastic storeys, and damping forces C v; 0
// where C is full.
void chain_forces(const struct chain *c, const double *u, const double *v, double *drift,
                  double *shear, double *damping);

// External forces -m base of the ground accelerations below each floor.
void chain_inertia(const struct chain *c, const double *base, double *external);

// r = external - m a - damping - shear below + shear above.
void chain_residual(const struct chain *c, const double *external, const double *a,
                    const double *damping, const double *shear, double *r);

#endif
