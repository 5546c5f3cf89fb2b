// SPDX-License-Identifier: GPL-3.0-or-later
// All floors of all buildings as one chain: what is done for every floor in every step runs over
// flat arrays, whatever the number of buildings. The joint between the roof of one building and
// the first floor of the next is 0. Arrays are those of core/lanes.h.
#ifndef JOSTLE_CHAIN_H
#define JOSTLE_CHAIN_H

#include "jostle/analysis.h"

struct chain {
    int n;              // degrees of freedom, in whole lanes
    double *mass;       // [M] (n)
    double *stiffness;  // [F/L] (n) initial, of the storey below
    double *joint;      // (n + 1) 1: floor i stands on floor i - 1; else 0
    double *damping_below, *damping, *damping_above;  // [F T/L] (n) bands of C; 0 where it is full
};

// An array for n_dof values and one zero behind them; NULL: no memory.
double *chain_array(const struct model *m, struct arena *a);

// The chain of a model; false: no memory.
bool chain_alloc(struct chain *c, const struct model *m, struct arena *a);

// u_t = u + h v + h^2 a / 2 and v_t = v + h a: the end of the step if the accelerations stay.
void chain_trial(const struct chain *c, double h, const double *u, const double *v, const double *a,
                 double *u_t, double *v_t);

// Drifts of the storeys below each floor, and the shears of elastic storeys.
void chain_drifts(const struct chain *c, const double *u, double *drift, double *shear);

// The damping forces C v, but for buildings whose C is full: there 0.
void chain_damping(const struct chain *c, const double *v, double *force);

// r = external - m a - damping - shear below + shear above.
void chain_residual(const struct chain *c, const double *external, const double *a,
                    const double *damping, const double *shear, double *r);

// u = u_t + b q, v = v_t + g q, a = a_0 + q; total = a + base. False: not all is finite.
bool chain_correct(const struct chain *c, double b, double g, const double *q, const double *u_t,
                   const double *v_t, const double *a_0, const double *base, double *u, double *v,
                   double *a, double *total);

// Adds to `work` (n) twice what a force that goes from f0 to f1 does while u0 becomes u1.
void chain_work(const struct chain *c, const double *f0, const double *f1, const double *u0,
                const double *u1, double *work);

// Is any |x[q][i]| greater than peak[q][i]?
enum { CHAIN_PEAKS = PEAK_COUNT };
bool chain_exceeds(const struct chain *c, const double *const x[CHAIN_PEAKS],
                   double *const peak[CHAIN_PEAKS]);

#endif
