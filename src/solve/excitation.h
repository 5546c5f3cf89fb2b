// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions and loads at an instant.
#ifndef JOSTLE_EXCITATION_H
#define JOSTLE_EXCITATION_H

#include "solve/state.h"

// Sets the ground's acceleration (and, where links need them, velocity and displacement) and the
// external forces -m a_ground + p of `s` to time t.
void excitation_at(struct state *s, const struct model *m, double t);

// Its parts: what is of the grounds, and what is of the floors.
void excitation_grounds(struct state *s, const struct model *m, double t);
void excitation_floors(struct state *s, const struct model *m, double t);

#endif
