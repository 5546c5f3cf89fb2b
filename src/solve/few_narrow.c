// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in vectors of four, for all processors.
#define FEW_STEPS few_narrow

#include "solve/few_steps.h"
