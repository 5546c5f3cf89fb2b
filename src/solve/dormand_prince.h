// SPDX-License-Identifier: GPL-3.0-or-later
// Dormand & Prince's method with error control, for adaptive analyses.
#ifndef JOSTLE_DORMAND_PRINCE_H
#define JOSTLE_DORMAND_PRINCE_H

#include "solve/energy.h"
#include "solve/impacts.h"

struct dp;

// An integrator for model `m` that keeps its peaks in `r` and its impacts in `log`, all borrowed.
// NULL: no memory.
struct dp *dormand_prince_create(const struct model *m, struct results *r, struct impact_log *log,
                                 struct arena *a);

// Begins at state `start`, with its energies.
void dormand_prince_start(struct dp *p, const struct state *start,
                          const struct energy_account *energy);

// Time that has been reached.
double dormand_prince_time(const struct dp *p);

// One step further, at most to the next corner of the forcing or the end of the analysis.
// STATUS_FAILED: the steps become too short or too many; names the time and the cause.
int dormand_prince_step(struct dp *p, struct error *e);

// The state at time t of the last step, and the account of energy up to it.
void dormand_prince_row(struct dp *p, double t, struct state *row, struct energy_account *energy);

#endif
