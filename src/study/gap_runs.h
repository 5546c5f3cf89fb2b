// SPDX-License-Identifier: GPL-3.0-or-later
// All runs of a deck at several gaps, in memory.
#ifndef JOSTLE_GAP_RUNS_H
#define JOSTLE_GAP_RUNS_H

#include "jostle/analysis.h"
#include "study/plan.h"

// The runs of a deck at one gap.
struct gap_runs_case {
    const struct plan *plan;
    double gap;  // [L] of all its contacts; NAN: as the deck has it; infinite: they never close
};

// Takes what is wanted from a run: `m` as it was run, `deck` as the deck has it. Errors:
// STATUS_SYSTEM (no memory).
typedef int gap_runs_read(void *context, const struct model *m, const struct model *deck,
                          const struct results *r, double *value, struct error *e);

struct gap_runs {
    const struct gap_runs_case *which;  // (n_case) plans of as many runs
    int n_case, n_thread;
    size_t n_value;                 // of a run
    struct study_outcome *outcome;  // (n_case, n_run) out
    double *value;                  // (n_case, n_run, n_value) out; NAN where a run failed
    gap_runs_read *read;
    // Called every 0.1 s; a result other than 0 ends the runs with that status. NULL: never.
    int (*poll)(void *context, long n_done, struct error *e);
    void *context;
};

// Runs all; the results do not depend on the number of threads. Errors: STATUS_INPUT (runs differ
// in their buildings or contacts), STATUS_SYSTEM, or what poll returned.
int gap_runs_run(const struct gap_runs *s, struct error *e);

#endif
