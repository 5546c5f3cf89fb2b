// SPDX-License-Identifier: GPL-3.0-or-later
// Works and impulses of steps of Dormand & Prince's method, and the state within a step.
#ifndef JOSTLE_DP_ACCOUNT_H
#define JOSTLE_DP_ACCOUNT_H

#include "solve/dormand_prince/dp.h"

// Takes the step into the accounts of energy and of impacts.
void dp_account_step(struct dp *p);

// The state at time t of the step, and the account of energy up to it.
void dp_account_row(struct dp *p, double t, struct state *row, struct energy_account *energy);

#endif
