// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of bodies whose rigid contacts are at rest, in a step: their forces at once.
#ifndef JOSTLE_REST_ROWS_H
#define JOSTLE_REST_ROWS_H

#include "solve/together.h"
#include "solve/work.h"

// Finds the contacts at rest. False if no two of them can stand in a row.
bool rest_rows_find(const struct work *w, const struct state *next, struct together *t);

// Gives all contacts of each row the forces that solve it while all others are held.
void rest_rows_settle(struct work *w, const struct state *now, const struct state *next,
                      const struct together *t);

#endif
