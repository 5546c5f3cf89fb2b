// SPDX-License-Identifier: GPL-3.0-or-later
// A Newton step on all active links together, to speed up the sweeps of contact.c.
#ifndef JOSTLE_BLOCK_H
#define JOSTLE_BLOCK_H

#include "solve/work.h"

// Tries a Newton step on the forces of the active links, whole and shortened. Keeps the first that
// halves the distance of the forces from their exact single answers and returns true; else leaves
// everything as it was and returns false.
bool block_step(struct work *w, const struct state *now, struct state *next);

#endif
