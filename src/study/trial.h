// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a study, in memory.
#ifndef JOSTLE_TRIAL_H
#define JOSTLE_TRIAL_H

#include "jostle/analysis.h"
#include "study/edp.h"
#include "study/plan.h"
#include "study/workers.h"

// What a trial asks of the study it belongs to. A result other than 0 ends the trial with that
// status.
struct trial_watch {
    // The deck of the run has been read; `files` are those it read. NULL: that is of no interest.
    int (*files)(void *context, const struct deck_path *files, struct error *e);
    // Called now and then. NULL: never.
    int (*poll)(void *context, double time, struct error *e);
    // The run of `m` starts, shows a row of its histories, has ended without an error. All three
    // or none are NULL. Runs that have them are taken one at a time.
    void (*begin)(void *context, const struct model *m);
    int (*row)(void *context, const struct row_view *row, struct error *e);
    int (*end)(void *context, const struct results *r, struct error *e);
    void *context;
    long steps_max;                // of a run; 0: no limit
    struct record_cache *records;  // that all trials share
};

// Opens the deck of run `run` with the values of its sweeps. `choice` has room for
// STUDY_SWEEPS_MAX, and must last as long as the deck. Errors: STATUS_SYSTEM.
int trial_open(const struct plan *p, long run, int *choice, struct deck **out, struct error *e);

// Notes that a run failed, and why.
void trial_fail(struct study_outcome *outcome, const char *message);

// What is done with the model of a run. Errors as of trial_run.
typedef int trial_use(void *context, const struct model *m, struct study_outcome *outcome,
                      struct error *e);

// Builds the model of run `run` and hands it to `use`, unless the deck is wrong for its values,
// which is an outcome. Errors as of trial_run.
int trial_build(const struct plan *p, long run, const struct trial_watch *watch, trial_use *use,
                void *context, struct study_outcome *outcome, struct error *e);

// Runs a model. An analysis that fails is an outcome, and *out is NULL; otherwise it must be given
// to results_free. Errors as of trial_run.
int trial_analyse(const struct model *m, const struct trial_watch *watch,
                  struct study_outcome *outcome, struct results **out, struct error *e);

// The values of a run as its table has them. Errors: STATUS_SYSTEM (no memory).
int trial_values(const struct model *m, const struct results *r, double *value, struct error *e);

// The demand of a run; infinite for one of a building in a run that collapsed. `all` is room for
// the values of the run. Errors: STATUS_INPUT (it has no value), STATUS_SYSTEM (no memory).
int trial_demand(const struct model *m, const struct results *r, const struct edp *edp, double *all,
                 double *value, struct error *e);

// A run of which only one demand is asked.
struct trial_question {
    const struct plan *plan;
    long run;
    const struct edp *edp;
    struct record_cache *records;
    struct workers *workers;  // that make the run
    double *all;              // room for the values of the run
};

// Makes the run. *demand is NAN if it failed. Errors as of trial_run and trial_demand.
int trial_ask(const struct trial_question *q, double *demand, struct study_outcome *outcome,
              struct error *e);

struct trial {
    long run;       // of the study, from 0
    long entry;     // its place in the journal; not used here
    double *value;  // (n_value) borrowed: its values, NaN if it failed
    struct study_outcome outcome;
    int status;  // 0, or an error that ends the study
    struct error error;
};

// How many runs of a plan are worth running at once, where they have no histories: 1 where they
// cannot go in lockstep, and never more than ENSEMBLE_MAX.
int trial_most(const struct plan *p);

// Builds the models of `n` <= ENSEMBLE_MAX runs and runs them: the outcome and the values of each,
// which do not depend on what else is run. A deck that is wrong for its values and an analysis that
// fails are outcomes; errors are those that end the study: STATUS_INPUT (the run has another
// shape), STATUS_SYSTEM, or what the watch returned.
void trial_run(const struct plan *p, struct trial *trial, int n, const struct trial_watch *watch);

#endif
