// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of an ensemble where a register holds all lanes.
#define FLOORS_OF_RUNS
#define FLOORS_WIDE
#define STEPS ensemble_whole

#include "solve/ensemble/ensemble_steps.h"
