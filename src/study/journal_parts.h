// SPDX-License-Identifier: GPL-3.0-or-later
// What journal.c and journal_blocks.c share.
#ifndef JOSTLE_JOURNAL_PARTS_H
#define JOSTLE_JOURNAL_PARTS_H

#include "study/entry.h"
#include "study/journal.h"

// Room for an entry of `n` bytes in the buffer; false: there is no memory.
bool journal_reserve(struct journal *j, size_t n);

// Appends the entry whose `n` bytes of content are in the buffer, from entry_content on. Errors:
// STATUS_SYSTEM; the journal stays as it was.
int journal_append(struct journal *j, enum entry_kind kind, size_t n, struct error *e);

// The entry at `at` into the buffer: 1 with *n, the bytes of its content; 0 if there is no sound
// one; else an error.
int journal_load_entry(struct journal *j, off_t at, enum entry_kind *kind, size_t *n,
                       struct error *e);

// The error of a run that was there and is not.
int journal_lost(const struct journal *j, long run, struct error *e);

// The block at j->end is another one of its run, if it stands behind those that there are.
void journal_link_block(struct journal *j, const struct entry_block *b);

// Whether the histories of the run, which ended with this status, are there as they are wanted.
bool journal_has_blocks(const struct journal *j, const struct entry_run *run, int status);

#endif
