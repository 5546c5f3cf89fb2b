// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_STUDY_RUNS_H
#define JOSTLE_STUDY_RUNS_H

#include "jostle/study_file.h"

struct study_run {
    long number;  // in the study, from 0
    struct study_outcome outcome;
    const double *value;  // (n_value)
};

// Calls `take` for each run in turn, of which a block is in memory. Errors: STATUS_INPUT (a damaged
// file), STATUS_SYSTEM.
int study_runs_each(struct study_file *f, void (*take)(void *context, const struct study_run *r),
                    void *context, struct error *e);

// Which value of sweep `i` a run has.
int study_runs_choice(const struct study_view *v, long number, int i);

// "done", "failed", or "missing": not in the file.
const char *study_runs_status(const struct study_run *r);

#endif
