// SPDX-License-Identifier: GPL-3.0-or-later
// Drifts that remain after the shaking.
#ifndef JOSTLE_RESIDUAL_DRIFT_H
#define JOSTLE_RESIDUAL_DRIFT_H

#include "solve/state.h"

// The size of the residual drift [L] of each storey (n_dof): where its law has no shear when the
// storey unloads from state `s`; 0 of elastic ones. NAN: the law does not unload to zero.
void residual_drifts(const struct model *m, const struct state *s, double *out);

#endif
