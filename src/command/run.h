// SPDX-License-Identifier: GPL-3.0-or-later
// What `jostle run` was asked for, and its half for studies.
#ifndef JOSTLE_RUN_H
#define JOSTLE_RUN_H

#include "command/load.h"
#include "jostle/study.h"

struct run_options {
    struct load_request load;
    struct guidance guidance;
    int n_word;
    char **word;  // (n_word) of the command
    const char *output;
    enum result_existing existing;
    enum study_journal journal;
    int n_thread;              // 0: all cores
    struct study_shard shard;  // of a study; n = 0: the whole
};

// Runs the study whose first model is `first`; returns the exit status.
int run_study(const struct model *first, const struct run_options *o,
              const struct result_options *result);

#endif
