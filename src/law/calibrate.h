// SPDX-License-Identifier: GPL-3.0-or-later
// The damping ratio with which a law delivers a given coefficient of restitution.
#ifndef JOSTLE_CALIBRATE_H
#define JOSTLE_CALIBRATE_H

#include "jostle/contact_law.h"

// The value of row `zeta` with which an isolated impact has the restitution e. The impact has k, m
// and v0 equal to 1; other rows have their fallback. For the `exact` of a law whose restitution
// depends only on zeta and falls with it. The search starts at `guess` > 0. NAN: no such value was
// found, or no memory.
double calibrate_by_impact(const struct contact_law *law, double e, double guess);

#endif
