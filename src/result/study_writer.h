// SPDX-License-Identifier: GPL-3.0-or-later
// The writer of study files, shared by study_file.c (values) and study_tree.c (everything else).
#ifndef JOSTLE_STUDY_WRITER_H
#define JOSTLE_STUDY_WRITER_H

#include "jostle/study_file.h"
#include "result/h5.h"

struct study_writer {
    struct h5 h;
    const struct study_content *content;  // borrowed
    const char *command_line;             // borrowed
    struct sweep runs;                    // of a part: the numbers of its runs
    int n_sweep;                          // that -D does not fix; 1 of a part
    const struct sweep *sweep[STUDY_SWEEPS_MAX];
    hid_t scale[STUDY_SWEEPS_MAX];  // of each
    hid_t *dataset;                 // (n_item) owned; -1: a sweep has its name
    hid_t status, message;
};

// Creates everything but the values of the runs.
void study_tree(struct study_writer *w);

// The values of a sweep as a scale of this name; open.
hid_t study_tree_sweep(struct study_writer *w, hid_t group, const struct sweep *s);

// Attributes of / that all runs share, and columns of links that do.
bool study_tree_is_shared(const struct column *c);
bool study_tree_is_fixed(const struct column *c);

// Of a part: its one dimension, and the group /part.
void study_part_dimension(struct study_writer *w);
void study_part_put(struct study_writer *w);

// The group /origin.
void study_origin_put(struct study_writer *w);

// STATUS_INPUT if a sweep has a name that something else has in the file.
int study_tree_check(const struct study_content *c, struct error *e);

#endif
