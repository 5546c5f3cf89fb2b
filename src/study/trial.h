// SPDX-License-Identifier: GPL-3.0-or-later
// Some runs of a study, in memory. Those whose models are alike go in lockstep.
#ifndef JOSTLE_TRIAL_H
#define JOSTLE_TRIAL_H

#include "study/plan.h"

// What a trial asks of the study it belongs to. Not 0 ends the trial with that status.
struct trial_watch {
    // The deck of a run has been read; `files` are those it read.
    int (*files)(void *context, const struct deck_path *files, struct error *e);
    // Called now and then.
    int (*poll)(void *context, double time, struct error *e);
    void *context;
    struct shelf *records;  // that all trials share
};

struct trial {
    long run;       // of the study, from 0
    long entry;     // its place in the journal; not used here
    double *value;  // (n_value) borrowed: its values, NaN if it failed
    struct study_outcome outcome;
    int status;  // 0, or an error that ends the study
    struct error error;
};

// How many runs of a plan are worth running at once: 1 where they cannot go in lockstep, and never
// more than ENSEMBLE_MAX.
int trial_most(const struct plan *p);

// Builds the models of `n` <= ENSEMBLE_MAX runs and runs them: the outcome and the values of each,
// which do not depend on what else is run. A deck that is wrong for its values and an analysis that
// fails are outcomes; errors are those that end the study: STATUS_INPUT (the run has another
// shape), STATUS_SYSTEM, or what the watch returned.
void trial_run(const struct plan *p, struct trial *trial, int n, const struct trial_watch *watch);

#endif
