// SPDX-License-Identifier: GPL-3.0-or-later
// Rayleigh damping of storeys that yield.
#ifndef JOSTLE_DAMPING_WARN_H
#define JOSTLE_DAMPING_WARN_H

#include <stddef.h>

#include "jostle/model.h"

enum { DAMPING_TEXT_SIZE = 512 };

// The warning about the dashpots of Rayleigh's alpha M + beta K in building `g`, whose storeys have
// the largest drift rates `rate` (n_floor) [L/T]; `known` says how the rates are known ("estimated
// ", or ""). Returns their force over the yield force, 0 where it is too small to warn about.
double damping_warning(const struct model *m, const struct building *g, const double *rate,
                       const char *known, char text[DAMPING_TEXT_SIZE]);

// The warning about the building whose dashpots carry most.
struct damping_finding {
    double share;  // 0: none
    int building;
    char text[DAMPING_TEXT_SIZE];
};

// Warns in the diagnostics of the model's deck, at rates estimated as in floor_velocity.h, if
// `warns`. Errors: STATUS_SYSTEM (no memory).
int damping_find(const struct model *m, bool warns, struct damping_finding *most, struct error *e);

#endif
