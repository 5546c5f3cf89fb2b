// SPDX-License-Identifier: GPL-3.0-or-later
// sweep NAME random ...: values drawn from a distribution.
#ifndef JOSTLE_SWEEP_RANDOM_H
#define JOSTLE_SWEEP_RANDOM_H

#include "deck/bundle.h"

// The values of the statement, drawn or those of the bound deck, and the bundle of the sweep. Where
// -D gives the parameter, only A of the distribution is kept. False after having reported what is
// wrong with them.
bool sweep_random(struct deck *d, const struct statement *s, struct sweep *own,
                  struct bundle_request *q);

#endif
