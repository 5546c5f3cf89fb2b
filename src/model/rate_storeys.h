// SPDX-License-Identifier: GPL-3.0-or-later
// Shear storeys whose law depends on the drift rate, as friction bearings. The loops over chains
// have no rates, but parts do. So such storeys of a building are a part of it, and its chain has
// storeys of stiffness 0 in their place.
#ifndef JOSTLE_RATE_STOREYS_H
#define JOSTLE_RATE_STOREYS_H

#include "model/builder.h"

// Adds the part to the draft and takes the stiffness of these storeys off `spring` of the building,
// if there are any and no foundation has the storeys in its own part.
void rate_storeys_put(struct builder *b, struct building_draft *d, struct building *g);

// Storey `i` (from 0) of a building, if it is in this part, with its history in that of the part;
// else NULL.
const struct storey *rate_storeys_of(const struct building *g, int i);

#endif
