// SPDX-License-Identifier: GPL-3.0-or-later
// The writer of study files, shared by study_file.c (values), study_tree.c and study_origin.c
// (everything else).
#ifndef JOSTLE_STUDY_WRITER_H
#define JOSTLE_STUDY_WRITER_H

#include "jostle/study_file.h"
#include "result/tree.h"

struct study_writer {
    struct h5 h;
    const struct study_content *content;  // borrowed
    const char *command_line;             // borrowed
    struct sweep runs;                    // of a part: the numbers of its runs
    struct tree tree;  // over the sweeps that -D does not fix, or the runs of a part
    hid_t *dataset;    // (n_item) owned; -1: a sweep has its name
    hid_t status, message;
};

// STATUS_INPUT if a sweep has a name that something else has in the file.
int study_tree_check(const struct study_content *c, struct error *e);

// Creates everything but the values of the runs.
void study_tree(struct study_writer *w);

// Of a part: its one dimension, and the group /part.
void study_part_dimension(struct study_writer *w);
void study_part_put(struct study_writer *w);

// The group /origin.
void study_origin_put(struct study_writer *w);

#endif
