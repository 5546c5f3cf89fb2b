// SPDX-License-Identifier: GPL-3.0-or-later
// Which study it is, as text: a line for each thing that must not change, which starts with what a
// message calls it and a tab. Equal texts mean the same runs, except for the files that they read,
// which the ledger holds. The build of the program does not count: the version of the numerics
// does.
#ifndef JOSTLE_IDENTITY_H
#define JOSTLE_IDENTITY_H

#include "core/arena.h"
#include "jostle/study.h"

// The same wherever the deck lies, for parts. `n_value` of a run. Errors: STATUS_SYSTEM (no
// memory).
int identity_study(struct arena *a, const struct study_request *q, size_t n_value, const char **out,
                   struct error *e);

// The same for the journal: of one part, and of a deck in one place.
const char *identity_journal(struct arena *a, const struct study_request *q, const char *study);

// Appends to the text *accepted a line for each difference that a user may accept: "NAME: OLD".
// Errors: STATUS_INPUT with the name of another difference, as runs would not have the same places
// or numbers; STATUS_SYSTEM (no memory).
int identity_accept(struct arena *a, const char *old, const char *new, const char **accepted,
                    struct error *e);

// What differs between two of them, to end after *length.
const char *identity_difference(const char *old, const char *new, int *length);

// Bytes of `path` up to and with its last slash.
size_t identity_folder(const char *path);

#endif
