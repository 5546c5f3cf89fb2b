// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in vectors of eight, for processors with such registers.
#include "core/lanes.h"

#ifdef LANES_HOLD_WIDE

#define FLOORS_WIDE
#define FEW_STEPS few_wide

#include "solve/few_steps.h"

#endif
