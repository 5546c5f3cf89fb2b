// SPDX-License-Identifier: GPL-3.0-or-later
// Finished runs out of study files, with the values that another study or file is to have of them.
#ifndef JOSTLE_TAKE_H
#define JOSTLE_TAKE_H

#include "jostle/study_file.h"
#include "study/plan.h"

struct record_cache;

struct take_file {
    struct study_file *file;
    const struct study_view *view;
    const struct study_table *table;  // borrowed: the values wanted
    int *item;                        // (n_item of the table) the item of the file; -1: none
    bool lacks;                       // it does not have some properties of the models
    long first, n, capacity;          // rows in memory
    struct study_outcome *outcome;    // (capacity)
    double *value;                    // (capacity, n_value of the file)
};

// Opens a study file and checks its checksum. *t is to be given to take_close, whatever happens.
// Errors as of study_file_open.
int take_open(struct take_file *t, const char *path, struct error *e);
void take_close(struct take_file *t);

// The values wanted from now on. Those that `sweeps` replaces in the file that is written may be
// missing, and so may properties of the models, for which the file has a sweep: they are NaN.
// Errors: STATUS_INPUT (others are missing), STATUS_SYSTEM (no memory).
int take_map(struct take_file *t, const struct study_table *table, const struct sweep *sweeps,
             struct error *e);

// Run `row` of the file. Rows are read in blocks, so a walk through the file is fast, in either
// direction and in steps. Errors as of study_file_read.
int take_row(struct take_file *t, long row, struct study_outcome *outcome, double *value,
             struct error *e);

// The properties that the file lacks, from the model of run `run` of the plan. Errors as of
// trial_build.
int take_fill(const struct take_file *t, const struct plan *p, long run,
              struct record_cache *records, double *value, struct error *e);

#endif
