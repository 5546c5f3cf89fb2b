// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities on the command line.
#ifndef JOSTLE_QUANTITY_WORD_H
#define JOSTLE_QUANTITY_WORD_H

#include "jostle/units.h"

// Whether a number without a unit is taken, as one in the units `u`.
enum bare { BARE_ALLOWED, BARE_REFUSED };

// Reads the number at the start of `text` and the unit that follows it; *value is in the units `u`.
// Returns the text after them; NULL: it is not such a quantity.
const char *quantity_word(const char *text, const struct unit_system *u,
                          const struct dimension *dimension, enum bare bare, double *value);

#endif
