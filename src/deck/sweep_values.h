// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a sweep that the deck lists.
#ifndef JOSTLE_SWEEP_VALUES_H
#define JOSTLE_SWEEP_VALUES_H

#include "deck/reader.h"

// Reads `w` as a value that fits `first` (NULL: any); false after having reported why it does not.
// Bare numbers are in the deck's units: they fit any dimension, and a bare first one takes that of
// the first other.
bool sweep_value(struct deck *d, const struct word *w, struct parameter *first,
                 struct parameter *p);

// The values `p` (n) as the sweep keeps them; false: no memory.
bool sweep_take(struct deck *d, struct sweep *s, const struct parameter *p, int n);

// The values of the statement sweep NAME values LIST, or sweep NAME range FROM TO N; false after
// having reported what is wrong with them.
enum repeats { VALUES_DIFFER, VALUES_MAY_REPEAT };
bool sweep_list(struct deck *d, const struct statement *s, enum repeats repeats,
                struct sweep *sweep);
enum spacing { SPACING_LINEAR, SPACING_LOG };
bool sweep_range(struct deck *d, const struct statement *s, enum spacing spacing,
                 struct sweep *sweep);

#endif
