// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of an ensemble where a register holds half of the lanes.
#define FLOORS_OF_RUNS
#define STEPS ensemble_half

#include "solve/ensemble/ensemble_steps.h"
