// SPDX-License-Identifier: GPL-3.0-or-later
// Ends of contacts and links that are not one floor: a level between two floors, `BUILDING@LEVEL`,
// and the difference of two ends within one building.
#ifndef JOSTLE_LEVEL_H
#define JOSTLE_LEVEL_H

#include "model/builder.h"

// What `w` names. A parameter that holds a level is replaced in it. END_WRONG: reported.
enum end_kind { END_FLOORS, END_LEVEL, END_WRONG };
enum end_kind level_kind(struct builder *b, struct word *w);

// Reads `w`, a level: the floor above it into `out`, and the level [L] into *level. A level within
// rounding of a floor is that floor: *level is NAN. Reports and returns false if it is wrong.
bool level_read(struct builder *b, const struct word *w, struct selection *out, double *level);

// Gives the link, whose buildings, floors and levels are known, the rows of its ends. False after
// having reported at `w` that both ends are the same.
bool level_rows(struct builder *b, struct link *l, const struct word *w);

// The effective mass of a link between buildings whose masses are known so far.
double level_effective_mass(struct builder *b, const struct link *l);

#endif
