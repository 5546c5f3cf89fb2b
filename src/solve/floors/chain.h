// SPDX-License-Identifier: GPL-3.0-or-later
// What is done for every floor in every step, one loop after the other over the flat arrays of
// struct chain. Arrays are those of core/lanes.h; none that is written is also read. Counts n of
// floors are rounded down to whole lanes.
#ifndef JOSTLE_CHAIN_H
#define JOSTLE_CHAIN_H

#include "core/lanes.h"
#include "jostle/analysis.h"

// Drifts of the storeys below each floor, and shears of elastic storeys.
void chain_strain(const struct chain *c, const double *u, double *drift, double *shear);

// The same at the end of a step of size h if the accelerations stay.
void chain_try(const struct chain *c, double h, const double *u, const double *v, const double *a,
               double *drift, double *shear);

// External forces -m base of the ground accelerations below each floor.
void chain_inertia(const struct chain *c, const double *base, double *external);

// r = external - damping - shear below + shear above, with the damping forces in r.
void chain_residual(const struct chain *c, const double *external, const double *shear, double *r);

#endif
