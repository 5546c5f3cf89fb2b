// SPDX-License-Identifier: GPL-3.0-or-later
// The accelerations of a state from its forces, at the start of a run and where forces jump.
#ifndef JOSTLE_EQUILIBRIUM_H
#define JOSTLE_EQUILIBRIUM_H

#include "solve/state.h"

// The state at t = 0: initial displacements and velocities, links closed where delta > 0 or about
// to close (delta = 0, rate > 0), rigid contacts where forces press them together (delta >= 0, rate
// = 0), accelerations from equilibrium. Storeys have come there from zero drift without turning;
// the histories of links are left to state_commit_links.
void equilibrium_start(struct state *s, const struct model *m);

// Accelerations that bring the forces of `s` into equilibrium, with the forces of rigid contacts at
// rest that keep them so; one that would have to pull opens.
void equilibrium_find(struct state *s, const struct model *m);

#endif
