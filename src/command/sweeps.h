// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_SWEEPS_H
#define JOSTLE_SWEEPS_H

#include "jostle/deck.h"

// Prints "study of N runs" and a line for each sweep to stdout; nothing for a deck without sweeps.
void sweeps_print(const struct deck *d);

#endif
