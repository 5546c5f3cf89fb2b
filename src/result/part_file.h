// SPDX-License-Identifier: GPL-3.0-or-later
// A file while it is being made: PATH.part, locked until it has its name, so that two runs never
// write one file. What a killed run has left is removed, what another one is writing is left alone.
#ifndef JOSTLE_PART_FILE_H
#define JOSTLE_PART_FILE_H

#include <stdio.h>

#include "jostle/result.h"

struct part_file {
    FILE *to;  // NULL: not open
    char path[4096], part[4096];
};

// Opens PATH.part for writing. Errors: STATUS_INPUT (the name is too long), STATUS_SYSTEM.
int part_file_open(struct part_file *p, const char *path, struct error *e);

// Gives the file its name and closes it, or removes it. Errors: those of result_publish, and
// STATUS_SYSTEM (something could not be written).
int part_file_publish(struct part_file *p, enum result_existing existing, struct error *e);

// Removes it, unless it is not open.
void part_file_drop(struct part_file *p);

// --- for files that are opened in other ways -----------------------------------------------------

// Removes a `part` of `path` that no run is writing. Errors: STATUS_SYSTEM.
int part_file_clear(const char *path, const char *part, struct error *e);

// Locks the open file; false if another run has done so before, or has removed it.
bool part_file_is_ours(int file, const char *part);

// Errors: STATUS_SYSTEM, always.
int part_file_taken(const char *path, const char *part, struct error *e);

#endif
