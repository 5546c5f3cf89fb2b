// SPDX-License-Identifier: GPL-3.0-or-later
// Contact stiffness from the bodies that meet, for `-k-from`.
#ifndef JOSTLE_STIFFNESS_ESTIMATE_H
#define JOSTLE_STIFFNESS_ESTIMATE_H

#include "jostle/deck.h"

// Options of the estimates, for help texts.
enum { STIFFNESS_HERTZ_ROWS = 6, STIFFNESS_SLAB_ROWS = 3, STIFFNESS_ROWS_MAX = 8 };
extern const struct row stiffness_hertz_rows[STIFFNESS_HERTZ_ROWS];
extern const struct row stiffness_slab_rows[STIFFNESS_SLAB_ROWS];

struct stiffness_estimate {
    const char *name;
    const struct row *row;
    int n_row;
    struct dimension dimension;                         // of the stiffness
    double (*stiffness)(const struct argument *given);  // in the deck's units
};
extern const struct stiffness_estimate stiffness_estimates[];
extern const int n_stiffness_estimate;

// The estimate called by the word; NULL after having reported that there is none.
const struct stiffness_estimate *stiffness_estimate_find(struct deck *d, const struct word *name);

#endif
