// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness-proportional damping on the tangent stiffness that was committed last: a part of its
// building, whose shears are viscous. Results show them with the damping, not with the storeys.
#ifndef JOSTLE_TANGENT_DAMPING_H
#define JOSTLE_TANGENT_DAMPING_H

#include "model/builder.h"

// Coefficients and initial stiffness, both on drifts. C of drift rates has the entries
// beta_ij K_ij, where K is the tangent stiffness.
struct tangent_damping {
    int n;
    double *beta;                 // [T] (n, n) symmetric
    double *initial;              // [F/L] (n, n) of storeys and parts
    const double *spring;         // [F/L] (n) of the storeys of the chain alone
    const struct storey *storey;  // (n) of the chain
    int n_part;                   // of the building, beside this one
    bool diagonal;                // all of these are PART_DIAGONAL, and so is K
    const struct part *part;      // (n_part)
};

// Can the tangent stiffness of the building change?
bool tangent_damping_matters(const struct building_draft *d, const struct building *g);

// Room for coefficients of 0 and the initial stiffness of building `g`; NULL: no memory.
struct tangent_damping *tangent_damping_create(struct arena *a, const struct building *g);

// Adds the part to building `g`, whose storeys of the chain are `storey` (n_dof) and whose
// `tangent` is set. Its history is behind the n_history values that there are.
void tangent_damping_put(struct builder *b, struct building_draft *d, struct building *g,
                         const struct storey *storey, int *n_history);

// The viscous shear of storey `i` (from 0) in the last committed state.
double tangent_damping_shear(const struct building *g, const double *history, int i);

#endif
