// SPDX-License-Identifier: GPL-3.0-or-later
// An open result file, shared by reader.c (tables) and histories.c.
#ifndef JOSTLE_READER_H
#define JOSTLE_READER_H

#include "result/h5.h"

struct result_file {
    struct h5 h;
    hid_t root;             // the file, or the group of a run of a study
    struct report *report;  // owned
    const char *path;       // in the report's arena
};

#endif
