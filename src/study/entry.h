// SPDX-License-Identifier: GPL-3.0-or-later
// The layout in bytes of the entries of a journal.
#ifndef JOSTLE_ENTRY_H
#define JOSTLE_ENTRY_H

#include <stdint.h>

#include "jostle/study_file.h"

enum entry_kind { ENTRY_HEAD_TEXT = 0x64616568, ENTRY_FILE = 0x656c6966, ENTRY_RUN = 0x206e7572 };
enum { ENTRY_HEAD = 8, ENTRY_TAIL = 8 };  // bytes before and after the content

// Which run it is, and how many entries of files precede it: it may have read those files.
struct entry_run {
    long number, n_file;
};

// The content of the entry at `entry`.
unsigned char *entry_content(unsigned char *entry);

// Completes an entry with `n` bytes of content; returns its size.
size_t entry_seal(unsigned char *entry, enum entry_kind kind, size_t n);

// Reads the kind and the size of the content from the head; false if it cannot be one.
bool entry_size(const unsigned char *entry, enum entry_kind *kind, size_t *n);
// True if it is a head from a machine with the other byte order.
bool entry_is_foreign(const unsigned char *entry);
// True if the checksum after the `n` bytes of content is right.
bool entry_is_sound(const unsigned char *entry, size_t n);

// Largest content of a run of `n_value` values.
size_t entry_run_size(size_t n_value);
// Fill the content and return its size; values of a failed run are not written.
size_t entry_put_run(unsigned char *entry, struct entry_run run,
                     const struct study_outcome *outcome, const double *value, size_t n_value);
size_t entry_file_size(const char *path);
size_t entry_put_file(unsigned char *entry, const char *path, uint64_t sum);

// Read the content, `n` bytes; false if it cannot be one. `value` NULL: the values are not wanted.
bool entry_get_run(const unsigned char *entry, size_t n, size_t n_value, struct entry_run *run,
                   struct study_outcome *outcome, double *value);
bool entry_get_file(const unsigned char *entry, size_t n, const char **path, uint64_t *sum);

#endif
