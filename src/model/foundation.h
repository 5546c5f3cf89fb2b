// SPDX-License-Identifier: GPL-3.0-or-later
// Foundations that sway and rock: springs and dashpots below a rigid slab.
#ifndef JOSTLE_FOUNDATION_H
#define JOSTLE_FOUNDATION_H

#include "model/builder.h"

// Puts the building `fixed` of the draft, which is complete, onto its foundation: `out` has the
// degrees of freedom of the building and of the foundation, and a part in place of storeys and
// parts. The history of the part is behind the n_history values that there are.
int foundation_put(struct builder *b, const struct building_draft *d, const struct building *fixed,
                   int *n_history, struct building *out, struct error *e);

// The number of forces that cancel the ground motion on rotations, and these forces, which are
// loads: the ground does not rotate.
int foundation_n_load(const struct model *m);
int foundation_loads(struct builder *b, const struct model *m, struct load *out);

// The law of storey `i` (from 0) of a building of the model, with or without a foundation.
const struct storey *foundation_storey(const struct model *m, const struct building *g, int i);

// Are the deformations and shears of storeys not the drifts and shears of the degrees of freedom?
// So it is on a foundation, and with damping on the tangent stiffness, which adds to the shears.
bool foundation_differs(const struct building *g);

// Storey deformations and shears (n_floor) of a building, from drifts and shears (n_dof) of its
// degrees of freedom, which are other arrays, and the storey history of the state.
void foundation_storeys(const struct building *g, const double *history, const double *drift,
                        const double *shear, double *own_drift, double *own_shear);

// What a unit drift of degree of freedom `j` adds to the deformation of storey `i`; and what a unit
// displacement of the roof by rocking adds to how far the storey leans (both from 0).
double foundation_deformation(const struct building *g, int i, int j);
double foundation_lean(const struct building *g, int i);

// A quantity (enum foundation_quantity) of the foundation by a unit drift of degree of freedom `j`
// (from 0).
double foundation_by_drift(const struct building *g, int q, int j);

// The deformation of storey `i` (from 0) of a building with a foundation, as a sum of
// displacements: of the floor above, the floor below or the slab, and the rocking.
struct foundation_row {
    int dof[3];
    double weight[3];
};
struct foundation_row foundation_row(const struct building *g, int i);

// The drift of the storey below floor `dof` of building `g` at the displacements x (n_dof of the
// model), an array of core/lanes.h. x may also be velocities or accelerations. With a foundation it
// is the drift of the storey alone. The second function finds the building.
double foundation_drift(const struct model *m, const struct building *g, int dof, const double *x);
double foundation_across(const struct model *m, int dof, const double *x);

#endif
