// SPDX-License-Identifier: GPL-3.0-or-later
// P-delta of a building on its initial stiffness. Displacements are small: a storey of height h
// that carries the gravity load P and has the drift d gets the shear -(P/h) d beside that of its
// resistance.
#ifndef JOSTLE_PDELTA_H
#define JOSTLE_PDELTA_H

#include "model/builder.h"

// Gives `g` the members of struct building on P-delta and takes P/h off g->spring, which is that of
// the storeys alone, as part_stiffness is that of parts. `omega` and `shape` are the modes without
// P-delta, and become those with it. Reports a building that buckles, and leaves it without modes.
int pdelta_apply(struct builder *b, const struct building_draft *d, struct building *g,
                 double *omega, double *shape, struct error *e);

// Reports a building with P-delta that buckles on its foundation.
void pdelta_check_founded(struct builder *b, const struct building_draft *d,
                          const struct building *g);

#endif
