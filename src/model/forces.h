// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that follow from the drifts of a building: the storey shears of its parts, where more than
// one resists, the forces of the members of its frames and walls, and what a foundation does. They
// are the rows of a matrix times the drifts; with hinges, times the drifts and the departures of
// their moments from their initial lines; and times the displacements of struck points of a frame.
// Those of all buildings are one list, in which each building begins at a whole lane.
#ifndef JOSTLE_FORCES_H
#define JOSTLE_FORCES_H

#include "core/arena.h"
#include "jostle/model.h"
#include "model/frame.h"

// What resists in a building beside others: number 0 is the shear storeys, the others its parts.
// The index of its first storey shear among the forces of the building; -1: it has none, as it is
// alone or not linear.
int forces_of_share(const struct building *g, int number);
const char *forces_share_name(const struct building *g, int number);

// The members of all frames and walls of the building, part by part.
int forces_n_member(const struct building *g);

// The index of force `which` (enum frame_force) of the first member of part `part` (from 0), which
// those of the next members follow.
int forces_of_members(const struct building *g, int part, int which);

// The index of the first quantity of the foundation (enum foundation_quantity); without one, the
// number of the others.
int forces_of_foundation(const struct building *g);

// Do rows of the histories have these forces?
static inline bool forces_in_rows(const struct model *m) {
    return m->n_force > 0 && (m->storeys_differ || m->output.fields & FIELD_MEMBERS);
}

// What is known of each member: FRAME_FORCES, or FRAME_QUANTITIES where the building has hinges.
int forces_quantities(const struct building *g);

// Fills n_force, force, force_by_action, hinges and struck points of building number `building`,
// whose parts and columns are there. The model has the forces and hinges of the buildings before;
// those of this one are added. False: no memory.
bool forces_create(struct building *g, int building, struct model *m, struct arena *a);

// The forces of the building at these drifts (n_dof), n_force rounded up to whole lanes. `history`
// is the storey history of the state. `struck` (n_dof of the model) has the displacements of struck
// points (struck_column_elastic).
void forces_at(const struct building *g, const double *drift, const double *history,
               const double *struck, double *force);

// Makes the forces that members do not have NAN.
void forces_hide(const struct building *g, double *force);

#endif
