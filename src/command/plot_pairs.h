// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a demand of two studies, run against run.
#ifndef JOSTLE_PLOT_PAIRS_H
#define JOSTLE_PLOT_PAIRS_H

#include "command/picture.h"

struct plot_pairs {
    const char *path[2];
    const char *edp;  // the demand; NULL: the default
    struct picture_options picture;
};

// Makes the picture and prints its name. Errors: STATUS_INPUT, STATUS_SYSTEM.
int plot_pairs(struct plot_pairs *q, struct error *e);

#endif
