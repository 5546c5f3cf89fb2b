// SPDX-License-Identifier: GPL-3.0-or-later
// What happens at the event that ended a step.
#ifndef JOSTLE_DP_HAPPEN_H
#define JOSTLE_DP_HAPPEN_H

#include "solve/dormand_prince/dp.h"

// Lets p->event happen at `now`, and begins again from there. STATUS_SYSTEM: no memory;
// STATUS_FAILED: what dormand-prince does not follow, or events without end.
int dp_happen(struct dp *p, struct error *e);

#endif
