// SPDX-License-Identifier: GPL-3.0-or-later
// The instant of an event.
#ifndef JOSTLE_DP_LOCATE_H
#define JOSTLE_DP_LOCATE_H

#include "solve/dormand_prince/dp.h"

// Takes the step again so that it ends at p->event.
void dp_locate(struct dp *p);

#endif
