// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as words of a command line: a number with its unit behind it.
#ifndef JOSTLE_QUANTITY_H
#define JOSTLE_QUANTITY_H

#include "jostle/units.h"

// Whether a number without a unit is taken, as one in the units `u`.
enum bare { BARE_ALLOWED, BARE_REFUSED };

// Reads the number at the start of `text` and the unit that follows it; *value is in the units `u`.
// Returns the text after them; NULL: it is not such a quantity.
const char *quantity_word(const char *text, const struct unit_system *u,
                          const struct dimension *dimension, enum bare bare, double *value);

// The whole of `text` as one quantity in SI. False: it is none.
bool quantity_whole(const char *text, const struct dimension *dimension, enum bare bare,
                    double *value);

// "A,B,C" in SI into `value`, which has room for `max`; units may be left out. Returns how many, 0:
// it is no such list. quantity_count: the number of its places.
int quantity_list(const char *text, const struct dimension *dimension, int max, double *value);
int quantity_count(const char *list);

#endif
