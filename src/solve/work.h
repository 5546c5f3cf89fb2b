// SPDX-License-Identifier: GPL-3.0-or-later
// Scratch of the solver, meaningless between steps but for the factors, which are kept as long as
// the step size and the tangents stay. All of it is allocated before the first step.
#ifndef JOSTLE_WORK_H
#define JOSTLE_WORK_H

#include "solve/effective.h"
#include "solve/line.h"
#include "solve/state.h"

// What to do where a contact or storey iteration does not converge.
enum strictness {
    STEP_STRICT,  // give STATUS_RETRY, so that the step is cut
    STEP_ACCEPT,  // take the last iterate and count it: the step is as short as it gets
};

struct work {
    const struct model *model;    // borrowed
    struct totals *totals;        // borrowed: counters
    struct effective *effective;  // (n_building)
    double h;                     // [T] step of the factors; 0: none yet
    double b, g;                  // beta h^2 and gamma h
    enum strictness strictness;
    int unresolved;  // link that last asked for a shorter step; -1: none did
    double speed;    // [L/T] largest velocity of any floor so far
    int held;        // link that stays open or closed in this step; -1: none

    double *u_predicted, *v_predicted;  // (n_dof) with a = 0 at the end of the step
    double *residual;                   // (n_dof) [F], then the correction of a
    bool *settled;                      // (n_building) storeys agree with the tangents used

    int n_active;                      // links whose force may change in this step
    int *active;                       // (n_link) their indices
    bool *is_active;                   // (n_link)
    enum branch *branch;               // (n_link) of active links
    double *kept_a, *kept_f;           // (n_dof), (n_link) to step back to
    double *matrix, *vector, *weight;  // (block_max, block_max), (block_max) of the block solve
    int block_max;
};

bool work_alloc(struct work *w, const struct model *m, struct totals *totals, struct arena *a);

// Makes the factors right for a step of size h. STATUS_RETRY: a matrix is not positive definite.
int work_factor(struct work *w, double h);

#endif
