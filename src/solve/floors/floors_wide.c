// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of floors in vectors of eight, for processors with such registers.
#include "core/lanes.h"

#ifdef LANES_HOLD_WIDE

#define FLOORS_WIDE
#define FLOORS_STEPS floors_wide

#include "solve/floors/floor_steps.h"

#endif
