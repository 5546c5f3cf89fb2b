// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in vectors of eight, for processors with such registers.
#include "core/lanes.h"

#ifdef LANES_HOLD_WIDE

#define FLOORS_WIDE
#define SMALL_STEPS small_wide

#include "solve/floors/small_steps.h"

#endif
