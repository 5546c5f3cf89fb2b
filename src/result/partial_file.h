// SPDX-License-Identifier: GPL-3.0-or-later
// A file while it is being made: PATH.part, locked until it has its name, so that two runs never
// write one file. What a killed run has left is removed, what another one is writing is left alone.
#ifndef JOSTLE_PARTIAL_FILE_H
#define JOSTLE_PARTIAL_FILE_H

#include <stdio.h>

#include "jostle/result.h"

struct partial_file {
    FILE *to;         // NULL: not open
    char path[4096];  // the name it will have
    char name[4096];  // PATH.part
    enum result_existing existing;
};

// Opens PATH.part for writing. Errors: those of result_check_path, STATUS_INPUT (the name is too
// long), STATUS_SYSTEM (another run is writing it).
int partial_file_open(struct partial_file *f, const char *path, enum result_existing existing,
                      struct error *e);

// Gives the file its name and closes it, or removes it. Errors: those of result_publish, and
// STATUS_SYSTEM (something could not be written).
int partial_file_publish(struct partial_file *f, struct error *e);

// Removes it, unless it is not open.
void partial_file_drop(struct partial_file *f);

// For files that are opened in other ways: removes a `partial` of `path` that no run is writing.
// Errors: those of file_claim.
int partial_file_clear(const char *path, const char *partial, struct error *e);

#endif
