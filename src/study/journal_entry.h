// SPDX-License-Identifier: GPL-3.0-or-later
// The entries of a journal: their layout in bytes, and how they are appended and read.
#ifndef JOSTLE_JOURNAL_ENTRY_H
#define JOSTLE_JOURNAL_ENTRY_H

#include <stdint.h>

#include "study/journal.h"

enum entry_kind {
    ENTRY_HEAD_TEXT = 0x64616568,
    ENTRY_STATE = 0x74617473,
    ENTRY_BLOCK = 0x636f6c62,
    ENTRY_RUN = 0x206e7572
};
enum { ENTRY_HEAD = 8, ENTRY_TAIL = 8 };  // bytes before and after the content

// Which run it is: its key, and its number at the start that ran it. `count` runs have this key. Of
// a run with histories also which rows they have (0: there are none), how many blocks they take,
// and where the last one is.
struct entry_run {
    struct study_key key;
    int64_t number, count;
    uint64_t shape;
    int64_t n_block, last;
    int64_t collapsed;  // 1: it has collapsed
};

// How the content of a run starts; the message and, if it is done, the values follow.
struct journal_run_head {
    struct entry_run run;
    int32_t status;
    int32_t n_message;
};

// A block of the histories of a run: block `index` of it, behind the one at `previous`.
struct entry_block {
    int64_t run, index, previous;
};
enum { ENTRY_BLOCK_BYTES = 1 << 18 };  // most bytes of histories in a block

// Reads the kind and the size of the content of an entry from its first ENTRY_HEAD bytes; false:
// they cannot be those of an entry.
bool journal_entry_size(const unsigned char *entry, enum entry_kind *kind, size_t *n);

// The content of the entry at `entry`.
unsigned char *journal_entry_content(unsigned char *entry);

// True if the entry is a head from a machine with the other byte order.
bool journal_entry_is_foreign(const unsigned char *entry);

// Largest content of a run of `n_value` values.
size_t journal_entry_run_size(size_t n_value);
// Fill the content and return its size; values of a failed run are not written.
size_t journal_entry_put_run(unsigned char *entry, struct entry_run run,
                             const struct study_outcome *outcome, const double *value,
                             size_t n_value);
// Fills the content of a block with `n` <= ENTRY_BLOCK_BYTES bytes of histories; its size.
size_t journal_entry_put_block(unsigned char *entry, struct entry_block block, const void *bytes,
                               size_t n);

// Read the content, `n` bytes; false if it cannot be one. `value` NULL: the values are not wanted.
bool journal_entry_get_run(const unsigned char *entry, size_t n, size_t n_value,
                           struct entry_run *run, struct study_outcome *outcome, double *value);
// Its bytes of histories, of which there are n - sizeof *block; NULL if it cannot be one.
const unsigned char *journal_entry_get_block(const unsigned char *entry, size_t n,
                                             struct entry_block *block);

// The error of an operation on the file: STATUS_SYSTEM with the cause in errno.
int journal_cannot(const struct journal *j, const char *what, struct error *e);

// Room for an entry of `n` bytes in the buffer; false: there is no memory.
bool journal_reserve(struct journal *j, size_t n);

// Appends the entry whose `n` bytes of content are in the buffer, from journal_entry_content on.
// Errors: STATUS_SYSTEM; the journal stays as it was.
int journal_append(struct journal *j, enum entry_kind kind, size_t n, struct error *e);

// The entry at `at` into the buffer: 1 with *n, the bytes of its content; 0 if there is no sound
// one; else an error.
int journal_load_entry(struct journal *j, off_t at, enum entry_kind *kind, size_t *n,
                       struct error *e);
// The same for the next sound entry from *at on; *at is where it starts.
int journal_find_entry(struct journal *j, off_t *at, enum entry_kind *kind, size_t *n,
                       struct error *e);
// Does the file end amid an entry, as where the program was killed as it wrote?
bool journal_is_torn(const struct journal *j, off_t at);

#endif
