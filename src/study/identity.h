// SPDX-License-Identifier: GPL-3.0-or-later
// Which study it is, as text: a line for each thing that must not change, which starts with what a
// message calls it and a tab. Equal texts mean the same runs, but for the files they read, which
// the ledger holds.
#ifndef JOSTLE_IDENTITY_H
#define JOSTLE_IDENTITY_H

#include "core/arena.h"
#include "jostle/study.h"

// The same wherever the deck lies, for parts. NULL: no memory. `n_value` of a run.
const char *identity_study(struct arena *a, const struct study_request *q, size_t n_value);

// The same for the journal: of one part, and of a deck in one place.
const char *identity_journal(struct arena *a, const struct study_request *q, const char *study);

// What differs between two of them, to end after *length.
const char *identity_difference(const char *old, const char *new, int *length);

// Bytes of `path` up to and with its last slash.
size_t identity_folder(const char *path);

#endif
