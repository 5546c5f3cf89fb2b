// SPDX-License-Identifier: GPL-3.0-or-later
// The floors of a step in vectors of eight, for processors with such registers.
#include "core/lanes.h"

#ifdef LANES_HOLD_WIDE

#define FLOORS_WIDE
#define DP_FLOORS dp_wide

#include "solve/dormand_prince/dp_floors.h"

#endif
