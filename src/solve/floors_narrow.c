// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of floors in vectors of four, for all processors.
#define FLOORS_STEPS floors_narrow
#define FLOORS_MULTIPLY effective_multiply

#include "solve/floor_steps.h"
