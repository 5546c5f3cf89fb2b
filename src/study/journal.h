// SPDX-License-Identifier: GPL-3.0-or-later
// The finished runs of a study on disk while it runs, one entry appended after the other, so that a
// killed program loses the runs in flight and a power cut what was not yet synchronised.
//
// A file starts with a magic word. An entry is {kind, bytes of content}, the content, and the
// checksum of both; numbers and the checksum are in the machine's order of bytes, and a journal
// from a machine with another one is not read. The first entry is the head: lines of text that say
// which study this is. Bytes that are no sound entry are passed over. If the entry of a file is
// lost, so are the runs that may have read that file, as it may have changed.
//
// The histories of a run precede its entry in blocks, each of which says where the one before it
// is; blocks of several runs may be mixed. A run is lost if one of its blocks is.
#ifndef JOSTLE_JOURNAL_H
#define JOSTLE_JOURNAL_H

#include <stdint.h>
#include <sys/types.h>

#include "jostle/study_file.h"

// The blocks of a run so far.
struct journal_chain {
    long n;
    int64_t last;  // offset of the last one
};

struct journal {
    char *path;  // owned
    int file;
    off_t end;                    // of the last sound entry
    long n_run;                   // of the study, or of the part of it
    size_t n_value;               // of a run
    int64_t *offset;              // (n_run) of the entry of each run; 0: not there
    uint64_t shape;               // of the rows of histories; 0: there are none
    struct journal_chain *chain;  // (n_run) of each run; NULL without histories
    unsigned char *buffer;        // (capacity) for one entry
    size_t capacity;
    long n_done, n_failed;  // runs in it
    long n_file;            // entries of files up to its end
    long n_damaged;         // places that were passed over
    char *head;             // the last one in the file; NULL: there is none, or a damaged one
    const char *accepted;   // what had changed when the user went on; in the memory of the head
};

// A file that runs read: the entries of kind file.
typedef int journal_file_function(void *context, const char *path, const struct checksum *sum,
                                  struct error *e);

// Opens the journal, or makes an empty one, and locks it. With an old one `head` is filled and the
// caller decides by it: journal_load or journal_reset (without a head if journal_is_new). Errors:
// STATUS_INPUT (no journal), STATUS_SYSTEM (cannot be read or written, another program writes it).
int journal_open(struct journal *j, const char *path, long n_run, size_t n_value, struct error *e);

// From now on runs have histories, with rows of this shape, any number but 0: what tells them from
// histories of other rows. Runs that were done without them, or with others, are not loaded.
// Errors: STATUS_SYSTEM (no memory).
int journal_want_histories(struct journal *j, uint64_t shape, struct error *e);

// Is the file shorter than a journal with the head `head` and no runs, as one that was torn when it
// was made? A longer file without a sound head is damaged, and may hold runs.
bool journal_is_new(const struct journal *j, const char *head);

// Reads the entries after the head, and changes nothing; `file` is called for each file, and its
// errors are returned. A head among them, of journal_accept, replaces the one before.
int journal_load(struct journal *j, journal_file_function *file, void *context, struct error *e);

// Drops what is behind the last sound entry, so that entries can be appended.
int journal_go_on(struct journal *j, struct error *e);

// Appends another head: from here on the runs belong to it, and `accepted` says in which respects
// those before it do not.
int journal_accept(struct journal *j, const char *head, const char *accepted, struct error *e);

// Empties the journal and writes the head.
int journal_reset(struct journal *j, const char *head, struct error *e);

// Append an entry. Errors: STATUS_SYSTEM; the journal stays as it was.
int journal_add_file(struct journal *j, const char *path, const struct checksum *sum,
                     struct error *e);
int journal_add_run(struct journal *j, long run, const struct study_outcome *outcome,
                    const double *value, struct error *e);
// The next `n` <= ENTRY_BLOCK_BYTES bytes of the histories of a run; journal_begin_run before the
// first ones.
void journal_begin_run(struct journal *j, long run);
int journal_add_block(struct journal *j, long run, const void *bytes, size_t n, struct error *e);

// Forgets a run that is done, so that it is run again.
void journal_forget(struct journal *j, long run);

// Where the blocks of a run that is there are, from the first on; chain[run].n offsets, to be
// freed. Errors: STATUS_SYSTEM (no memory, damaged).
int journal_find_blocks(struct journal *j, long run, int64_t **offset, struct error *e);
// The bytes of histories in the block there, valid until the next call.
int journal_read_block(struct journal *j, long run, int64_t offset, const unsigned char **bytes,
                       size_t *n, struct error *e);

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
