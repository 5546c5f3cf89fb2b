// SPDX-License-Identifier: GPL-3.0-or-later
// The response of one storey, hinge or link to a path of deformations.
#ifndef JOSTLE_STOREY_LOOP_H
#define JOSTLE_STOREY_LOOP_H

#include <stddef.h>

#include "law/loop_law.h"

struct storey_point {
    double drift, shear, tangent;  // [L] [F] [F/L]
    double work;                   // on the storey [F L]
    double dissipated;             // work less what is stored [F L]
    double plastic;                // drift less shear over initial stiffness [L]
};

// A virgin storey and the path that it follows from drift 0.
struct storey_path {
    const struct loop_law *law;
    const double *constant;
    double stiffness;      // initial; NAN: none
    double period;         // [T] of a cycle: from target to target in half of it, by half a wave of
                           // a cosine; 0: slowly, at rate 0
    const double *target;  // (n_target) drifts
    size_t n_target;
    int n_part;  // points from one target to the next
    int n_step;  // steps from one point to the next
};

// Sets point (n_target n_part + 1), the first of them at drift 0. Work is the sum of trapezoids
// over the steps.
void storey_loop_run(const struct storey_path *path, struct storey_point *point);

// Shears (n_target) at the targets, reached in one step each at rate 0.
void storey_loop_shears(const struct storey_path *path, double *shear);

#endif
