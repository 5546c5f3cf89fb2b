// SPDX-License-Identifier: GPL-3.0-or-later
// The damping matrix of a building from what the deck asks for.
#ifndef JOSTLE_DAMPING_H
#define JOSTLE_DAMPING_H

#include "model/builder.h"

// Does a statement give ratios of modes?
bool damping_is_modal(const struct building_draft *d);

// Fills damping_diagonal and damping_off, or damping_full, of `building` from the draft. `shape` is
// normalised to phi^T M phi = 1; it may be NULL unless the damping is modal. Reports in the deck
// what cannot be done.
void damping_matrix(struct builder *b, const struct building_draft *d, const double *omega,
                    const double *shape, struct building *building);

#endif
