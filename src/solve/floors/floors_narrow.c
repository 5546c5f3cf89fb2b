// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of floors in vectors of four, for all processors.
#define FLOORS_STEPS floors_narrow

#include "solve/floors/floor_steps.h"
