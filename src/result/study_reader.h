// SPDX-License-Identifier: GPL-3.0-or-later
// An open study file, shared by study_reader.c, study_runs.c, study_part.c and study_report.c.
#ifndef JOSTLE_STUDY_READER_H
#define JOSTLE_STUDY_READER_H

#include "jostle/study_file.h"
#include "result/h5.h"
#include "result/layout.h"

struct study_file {
    struct h5 h;
    struct study_view view;
    int n_dim;  // of the runs: the sweeps, or "run" of a part
    const struct sweep *dim[STUDY_SWEEPS_MAX];
    struct study_item *item;  // (capacity) malloc'd
    hid_t *dataset;           // (capacity) malloc'd
    int capacity;
    hid_t status, message;
};

// The sweep in the dataset `name`, open as `scale`, of a group.
struct sweep *study_reader_sweep(struct study_file *f, hid_t group, hid_t scale, const char *name);

// The names and floors of contacts or links, which are the same for all runs.
struct report_link *study_reader_links(struct study_file *f, struct arena *a,
                                       const struct link_group *g, int *n_link);

// The error for what the file's h5 has noted.
int study_reader_fail(const struct study_file *f, struct error *e);

// Reads /part into the view.
void study_part_get(struct study_file *f);
// Reads /origin into the view, if it is there.
void study_origin_get(struct study_file *f);

#endif
