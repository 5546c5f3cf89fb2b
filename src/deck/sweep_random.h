// SPDX-License-Identifier: GPL-3.0-or-later
// sweep NAME random ...: values drawn from a distribution.
#ifndef JOSTLE_SWEEP_RANDOM_H
#define JOSTLE_SWEEP_RANDOM_H

#include "deck/reader.h"

// Carries out the statement for the parameter of `own`, whose name is free: draws its values, or
// takes those of the bound deck, defines it, and adds it to its sample.
void sweep_random(struct deck *d, const struct statement *s, struct sweep *own);

#endif
