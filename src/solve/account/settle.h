// SPDX-License-Identifier: GPL-3.0-or-later
// Residual drifts of a building with parts, whose storeys come to rest together.
#ifndef JOSTLE_SETTLE_H
#define JOSTLE_SETTLE_H

#include "solve/state.h"

// The size of the residual drift [L] of each storey of building `b` (n_floor): where it has no
// shear at rest, reached straight from state `s`. NAN: not found, or no memory.
void settle_drifts(const struct model *m, const struct state *s, const struct building *b,
                   double *out);

#endif
