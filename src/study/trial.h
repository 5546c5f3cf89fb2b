// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a study, in memory.
#ifndef JOSTLE_TRIAL_H
#define JOSTLE_TRIAL_H

#include "study/plan.h"

// What a trial asks of the study it belongs to. Not 0 ends the trial with that status.
struct trial_watch {
    // The deck of the run has been read; `files` are those it read.
    int (*files)(void *context, const struct deck_path *files, struct error *e);
    // Called now and then.
    int (*poll)(void *context, double time, struct error *e);
    void *context;
    struct shelf *records;  // that all trials share
};

// Builds the model of run `run` and runs it: its outcome and its values (n_value), NaN if it
// failed. A deck that is wrong for these values and an analysis that fails are outcomes; errors are
// those that end the study: STATUS_INPUT (the run has another shape), STATUS_SYSTEM, or what the
// watch returned.
int trial_run(const struct plan *p, long run, const struct trial_watch *watch,
              struct study_outcome *outcome, double *value, struct error *e);

#endif
