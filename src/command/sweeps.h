// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_SWEEPS_H
#define JOSTLE_SWEEPS_H

#include <stdio.h>

#include "jostle/deck.h"

// For commands that look at one model only: prints "study of N runs", a line for each sweep, and
// that the model is that of the first run to stdout, with `before` and `after` around it; nothing
// for a deck without sweeps.
void sweeps_print_first(const struct deck *d, const char *before, const char *after);

// A line for the sweep and for each parameter along it; `u` is not needed where it comes from a
// file.
void sweeps_print(const struct sweep *s, const struct unit_system *u, FILE *to);

#endif
