// SPDX-License-Identifier: GPL-3.0-or-later
// What `show` prints of runs and studies.
#ifndef JOSTLE_SHOW_H
#define JOSTLE_SHOW_H

#include "command/printer.h"
#include "jostle/result.h"
#include "jostle/study_file.h"

// Of a run: the report as a table with a line for each value, which returns EXIT_DONE or, after a
// message, the exit status; and as JSON.
int show_table(const struct report *r, enum printer_form form, FILE *to);
void show_json(const struct report *r, FILE *to);

// Of a study.

// Writes what the study file at `path` holds: its sweeps, failures and largest values, or a table
// of all values, a line each. Errors as of study_file_open and study_file_read.
int show_study_summary(const char *path, FILE *to, struct error *e);
int show_study(const char *path, enum printer_form form, FILE *to, struct error *e);

struct show_demands_request {
    enum printer_form form;
    const char *const *edp;  // (n_edp) what is asked for; none: all, at all places
    int n_edp;
    bool wide;  // a line for each run, a column for each demand; else a line for each demand
    const char *const *im;  // (n_im) intensities of the ground motions
    int n_im;
    const char *deck;  // of the study, for these; NULL: that which the file names
};

// Writes a table of the demand parameters. Returns EXIT_DONE or, after a message, the exit status.
int show_demands(const char *path, const struct show_demands_request *q, FILE *to);

// Columns of the sweeps, and their cells in run `number`.
void show_add_sweeps(struct printer *t, const struct study_view *v);
void show_sweeps(struct printer *t, const struct study_view *v, long number);

#endif
