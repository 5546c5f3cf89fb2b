// SPDX-License-Identifier: GPL-3.0-or-later
// Computes runs of a study file again and compares their values bit by bit.
#ifndef JOSTLE_STUDY_RERUN_H
#define JOSTLE_STUDY_RERUN_H

#include "jostle/names.h"
#include "jostle/study.h"

JOSTLE_C_BEGIN

struct study_rerun_request {
    const struct model *first;  // the model of the deck of the study
    const char *const *define;  // (n_define) NAME=VALUE it was read with
    int n_define;
    int n_thread;            // at least 1
    const char *const *run;  // (n_run) texts that choose runs (study/selection.h)
    int n_run;
    long n_draw;  // so many runs of the file are drawn besides
    int seed;     // of the draw
    int (*poll)(void *context, double time, struct error *e);  // called now and then; or NULL
    void *context;
};

struct study_rerun {
    long n_same;        // runs with the same values
    long n_missing;     // runs that the file does not have
    char numbers[256];  // of the runs that were computed, from 1, as text
};

// The deck may have other runs besides, as runs are found by their keys (study/keys.h). Errors:
// STATUS_FAILED (values or the failure of a run differ; names the run and the value), STATUS_INPUT
// (the deck does not have a run any more; a run is not one of the study), STATUS_SYSTEM, and those
// of the poll.
int study_rerun(struct study_file *f, const struct study_rerun_request *q, struct study_rerun *out,
                struct error *e);

JOSTLE_C_END

#endif
