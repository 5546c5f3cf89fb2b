// SPDX-License-Identifier: GPL-3.0-or-later
// Runs several models at once: those of the same shape in lockstep, one run a lane of the
// processor's vectors, each with the results, to the last bit, that it has alone.
#ifndef JOSTLE_ENSEMBLE_H
#define JOSTLE_ENSEMBLE_H

#include "jostle/analysis.h"
#include "jostle/names.h"

JOSTLE_C_BEGIN

enum { ENSEMBLE_MAX = 8 };  // runs at once

// One run: its model, and what came of it.
struct ensemble_member {
    const struct model *model;  // borrowed
    int status;                 // as of analysis_run
    struct error error;         // if it is not 0
    struct results *results;    // to be given to results_free; NULL if it failed
};

// Whether runs of `m` and of models like it can go in lockstep: fixed steps, storeys that know
// their straight lines (struct storey_branch), no full damping, one ground, no loads, no bilateral
// links, contact laws with a force, and not so many floors that the state of all lanes would not
// stay near the processor.
bool ensemble_suits(const struct model *m);

// Whether runs of models with n_dof floors are faster in lockstep than one after the other where a
// register holds so many numbers, and on this processor. docs/performance.md has what was measured.
bool ensemble_pays_with(int in_register, int n_dof);
bool ensemble_pays(const struct model *m);

// Whether `b` can go in lockstep with `a`, which suits: the same floors, kinds of storeys,
// contacts, step and rows; all else may differ, the duration too.
bool ensemble_alike(const struct model *a, const struct model *b);

// Runs `n` <= ENSEMBLE_MAX models and fills in what came of each. Those without enough others like
// them run alone. The observer's poll is asked for each run; an observer that wants rows makes all
// run alone. totals.seconds of a run are those of all that went with it.
void ensemble_run(struct ensemble_member *member, int n, const struct observer *observer);

JOSTLE_C_END

#endif
