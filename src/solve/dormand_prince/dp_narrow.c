// SPDX-License-Identifier: GPL-3.0-or-later
// The floors of a step in vectors of four, for all processors.
#define DP_FLOORS dp_narrow

#include "solve/dormand_prince/dp_floors.h"
