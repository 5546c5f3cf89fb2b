// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in vectors of four, for all processors.
#define SMALL_STEPS small_narrow

#include "solve/floors/small_steps.h"
