// SPDX-License-Identifier: GPL-3.0-or-later
// An open study file, shared by study_reader.c and study_origin.c.
#ifndef JOSTLE_STUDY_READER_H
#define JOSTLE_STUDY_READER_H

#include "jostle/study_file.h"
#include "result/reader.h"

struct study_file {
    struct result_file file;  // its report is what the runs have in common
    struct study_view view;
    int n_dim;  // of the runs: the sweeps, or "run" of a part
    const struct sweep *dim[STUDY_SWEEPS_MAX];
    struct study_table *all;  // owned: what a run gives
    struct study_item *item;  // (n_item) of the values in the file
    hid_t *dataset;           // (n_item) of each
    hid_t status, message;
};

// Read /part and, if it is there, /origin into the view.
void study_part_get(struct study_file *f);
void study_origin_get(struct study_file *f);

#endif
