// SPDX-License-Identifier: GPL-3.0-or-later
// Rayleigh damping of storeys that yield.
#ifndef JOSTLE_DAMPING_WARN_H
#define JOSTLE_DAMPING_WARN_H

#include <stddef.h>

#include "jostle/model.h"

enum { DAMPING_TEXT_SIZE = 512 };

// The warning about the dashpots of Rayleigh's alpha M + beta K in building `g`, whose storeys have
// the largest drift rates `rate` (n_floor) [L/T]; `known` says how the rates are known ("estimated
// ", or ""). False: they carry too little to warn about.
bool damping_warning(const struct model *m, const struct building *g, const double *rate,
                     const char *known, char text[DAMPING_TEXT_SIZE]);

// Warns in the diagnostics of the model's deck, at rates estimated as in floor_velocity.h.
// Errors: STATUS_SYSTEM (no memory).
int damping_warn(const struct model *m, struct error *e);

#endif
