// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_SHOW_STUDY_H
#define JOSTLE_SHOW_STUDY_H

#include "command/cells.h"
#include "jostle/study_file.h"

enum show_content { STUDY_SUMMARY, STUDY_ALL, STUDY_DEMANDS };
struct show_study_request {
    enum show_content content;
    enum cells_form form;    // of tables
    const char *const *edp;  // (n_edp) demands asked for; none: all, at all places
    int n_edp;
};

// Writes what the study file at `path` holds: its sweeps, failures and largest values; a table of
// all values, a line each; or one of its demand parameters. Errors as of study_file_open,
// study_file_read and edp_parse.
int show_study(const char *path, const struct show_study_request *q, FILE *to, struct error *e);

// The table of demand parameters.
int show_demands(struct study_file *f, const struct show_study_request *q, FILE *to,
                 struct error *e);

// A cell for the value of each sweep in run `number`.
void show_sweep_cells(struct cells *c, const struct study_view *v, long number);

#endif
