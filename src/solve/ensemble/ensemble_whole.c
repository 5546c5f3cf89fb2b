// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of an ensemble where a register holds all lanes.
#include "solve/ensemble/ensemble_contacts.h"

#define FLOORS_OF_RUNS
#define FLOORS_WIDE
#define STEPS ensemble_whole
#define SOLVE ensemble_contacts_solve

#include "solve/ensemble/ensemble_steps.h"
