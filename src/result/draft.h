// SPDX-License-Identifier: GPL-3.0-or-later
// A file while it is being made: PATH.part, locked until it has its name, so that two runs never
// write one file. What a killed run has left is removed, what another one is writing is left alone.
#ifndef JOSTLE_DRAFT_H
#define JOSTLE_DRAFT_H

#include <stdio.h>

#include "jostle/result.h"

struct draft {
    FILE *to;         // NULL: not open
    char path[4096];  // the name it will have
    char name[4096];  // PATH.part
};

// Opens PATH.part for writing. Errors: STATUS_INPUT (the name is too long), STATUS_SYSTEM.
int draft_open(struct draft *d, const char *path, struct error *e);

// Gives the file its name and closes it, or removes it. Errors: those of result_publish, and
// STATUS_SYSTEM (something could not be written).
int draft_publish(struct draft *d, enum result_existing existing, struct error *e);

// Removes it, unless it is not open.
void draft_drop(struct draft *d);

// --- for files that are opened in other ways -----------------------------------------------------

// Makes the file; STATUS_RETRY: another run has come in between.
typedef int draft_function(void *context, const char *draft, struct error *e);

// Makes the `draft` of `path`. Between its making and its lock another run may take it for one that
// was left: then both try again, until one finds the file of another locked. Errors: STATUS_SYSTEM
// (another run is writing it, one that was left cannot be removed), or what `make` returns.
int draft_make(const char *path, const char *draft, draft_function *make, void *context,
               struct error *e);

// Locks the open file; false if another run has done so before, or has removed it.
bool draft_is_ours(int file, const char *draft);

// Removes a `draft` of `path` that no run is writing. Errors: STATUS_SYSTEM.
int draft_clear(const char *path, const char *draft, struct error *e);

#endif
