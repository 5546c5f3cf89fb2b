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

// The following add twice what forces do while u0 becomes u1 to `work`, floor i to element i %
// LANES_WIDTH: forces that go from f0 to f1,
void chain_work(const struct chain *c, const double *f0, const double *f1, const double *u0,
                const double *u1, double work[LANES_WIDTH]);

// those of a ground acceleration, the sum at both ends of which is given,
void chain_work_of_ground(const struct chain *c, double ground_2x, const double *u0,
                          const double *u1, double work[LANES_WIDTH]);

// and those of damping while the velocities go from v0 to v1; not where C is full.
void chain_work_of_damping(const struct chain *c, const double *u0, const double *u1,
                           const double *v0, const double *v1, double work[LANES_WIDTH]);

// Adds to work (n) twice what the shears do while they go from f0 to f1 and the drifts from d0 to
// d1.
void chain_storey_works(const struct chain *c, const double *f0, const double *f1, const double *d0,
                        const double *d1, double *work);

// Is any |x[q][i]| greater than peak[q][i], for i from `first` on, n of them in whole lanes?
bool chain_exceeds(int first, int n, const double *const x[PEAK_COUNT],
                   double *const peak[PEAK_COUNT]);

#endif
