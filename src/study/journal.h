// SPDX-License-Identifier: GPL-3.0-or-later
// The finished runs of a study on disk while it runs, one entry appended after the other, so that a
// killed program loses the runs in flight and a power cut what was not yet synchronised.
//
// A file starts with a magic word. An entry is {kind, bytes of content}, the content, and the
// checksum of both; numbers and the checksum are in the machine's order of bytes, and a journal
// from a machine with another one is not read. The first entry is the head: lines of text that say
// which study this is. What is no sound entry is passed over; after an entry of a file that is
// lost, so are the runs that may have read that file, which may have changed.
#ifndef JOSTLE_JOURNAL_H
#define JOSTLE_JOURNAL_H

#include <stdint.h>
#include <sys/types.h>

#include "jostle/study_file.h"

struct journal {
    char *path;  // owned
    int file;
    off_t end;              // of the last sound entry
    long n_run;             // of the study, or of the part of it
    size_t n_value;         // of a run
    int64_t *offset;        // (n_run) of the entry of each run; 0: not there
    unsigned char *buffer;  // (capacity) for one entry
    size_t capacity;
    long n_done, n_failed;  // runs in it
    long n_file;            // entries of files up to its end
    long n_damaged;         // places that were passed over
    char *head;             // found in the file; NULL: there is none, or a damaged one
};

// A file that runs read: the entries of kind file.
typedef int journal_file_function(void *context, const char *path, uint64_t sum, struct error *e);

// Opens the journal, or makes an empty one, and locks it. With an old one `head` is filled and the
// caller decides by it: journal_load or journal_reset (without a head if journal_is_new). Errors:
// STATUS_INPUT (no journal), STATUS_SYSTEM (cannot be read or written, another program writes it).
int journal_open(struct journal *j, const char *path, long n_run, size_t n_value, struct error *e);

// Does the file end before its head, if that is `head`, as one that was torn when it was made? What
// is longer and has no sound head is damaged, and may hold runs.
bool journal_is_new(const struct journal *j, const char *head);

// Reads the entries after the head; `file` is called for each file, and its errors are returned.
int journal_load(struct journal *j, journal_file_function *file, void *context, struct error *e);

// Empties the journal and writes the head.
int journal_reset(struct journal *j, const char *head, struct error *e);

// Append an entry. Errors: STATUS_SYSTEM; the journal stays as it was.
int journal_add_file(struct journal *j, const char *path, uint64_t sum, struct error *e);
int journal_add_run(struct journal *j, long run, const struct study_outcome *outcome,
                    const double *value, struct error *e);

// Reads a run that is there.
int journal_read(struct journal *j, long run, struct study_outcome *outcome, double *value,
                 struct error *e);

// Everything appended so far is on disk when this returns.
int journal_sync(const struct journal *j, struct error *e);

// Is the file still where it was opened? Else nobody finds what is in it.
bool journal_is_there(const struct journal *j);

void journal_close(struct journal *j);   // keeps the file
void journal_remove(struct journal *j);  // and removes it, if it is there

#endif
