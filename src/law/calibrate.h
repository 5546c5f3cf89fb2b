// SPDX-License-Identifier: GPL-3.0-or-later
// The damping that delivers a coefficient of restitution exactly.
#ifndef JOSTLE_CALIBRATE_H
#define JOSTLE_CALIBRATE_H

#include "jostle/contact_law.h"

// The value of row `zeta` with which isolated impacts of unit bodies (k, m, v0 are 1, other rows
// have their fallback) end with restitution e; for the `exact` of a law whose restitution depends
// on zeta alone and falls with it. `guess` > 0 starts the search. NAN: no such value is found, or
// no memory.
double calibrate_by_impact(const struct contact_law *law, double e, double guess);

#endif
