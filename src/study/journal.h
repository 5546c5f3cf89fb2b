// SPDX-License-Identifier: GPL-3.0-or-later
// The finished runs of a study on disk while it runs, one entry appended after the other, so that a
// killed program loses the runs in flight and a power cut what was not yet synchronised.
//
// A file starts with a magic word. An entry is {kind, bytes of content}, the content, and the
// checksum of both; numbers and the checksum are in the machine's order of bytes, and a journal
// from a machine with another one is not read. The first entry is the head: lines of text that say
// which values a run has. The entry of a run has its key (keys.h), by which the run is found,
// whatever its number is in a study that has grown since. Bytes that are no sound entry are passed
// over. Entries of states tell others how far the study is (status.h).
//
// The histories of a run precede its entry in blocks, each of which says where the one before it
// is; blocks of several runs may be mixed. A run is lost if one of its blocks is.
#ifndef JOSTLE_JOURNAL_H
#define JOSTLE_JOURNAL_H

#include <stdint.h>
#include <sys/types.h>

#include "jostle/study.h"
#include "study/keys.h"

// The blocks of a run so far. The run had this number at the start that ran it.
struct journal_chain {
    int64_t n, last;  // how many; offset of the last one
    int64_t number;
};

// How far a study is.
struct journal_state {
    int64_t n_run, n_done, n_failed, n_collapsed;
    int64_t ended;         // 1: the start has ended, and the study goes on with another one
    double time, started;  // wall time [s] since 1970: of this state, of the start
    double seconds_left;   // 0: not known
};

struct journal {
    char *path;  // owned
    int file;
    off_t end;                    // of the last sound entry
    const struct keys *keys;      // borrowed: of the runs of the study, or of the part of it
    size_t n_value;               // of a run
    bool retry;                   // entries of failed runs are not taken
    int64_t *offset;              // (n) of the entry of each run; 0: not there; < 0: the run is
                                  // elsewhere, and the place is the caller's (journal_take)
    uint64_t shape;               // of the rows of histories; 0: there are none
    struct journal_chain *chain;  // (n) of each run; NULL without histories
    struct journal_chain *found;  // (n_found) by their numbers, while entries are loaded
    long n_found;
    unsigned char *buffer;  // (capacity) for one entry
    size_t capacity;
    long n_done, n_failed, n_collapsed;  // runs in it, or elsewhere
    long n_foreign;                      // entries of runs that this study does not have
    long n_damaged;                      // places that were passed over
    char *head;                          // NULL: there is none, or a damaged one
};

// The place of the first entry in a file that begins with these JOURNAL_MAGIC bytes; 0: the file is
// not a journal of this version. NULL: it has fewer bytes.
enum { JOURNAL_MAGIC = 8 };
off_t journal_first(const unsigned char *bytes);

// Opens the journal, or makes an empty one, and locks it. With an old one `head` is filled and the
// caller decides by it: journal_load or journal_reset (without a head if journal_is_new). Errors:
// STATUS_INPUT (no journal), STATUS_SYSTEM (cannot be read or written, another program writes it).
int journal_open(struct journal *j, const char *path, const struct keys *keys, size_t n_value,
                 struct error *e);

// From now on runs have histories. `shape`, not 0, is a number of the form of their rows. Runs that
// were done without histories, or with rows of another shape, are not loaded. Errors: STATUS_SYSTEM
// (no memory).
int journal_want_histories(struct journal *j, uint64_t shape, struct error *e);

// Is the file shorter than a journal with the head `head` and no runs, as one that was torn when it
// was made? A longer file without a sound head is damaged, and may hold runs.
bool journal_is_new(const struct journal *j, const char *head);

// Reads the entries after the head, and changes nothing in the file. Errors: STATUS_SYSTEM.
int journal_load(struct journal *j, struct error *e);

// Drops what is behind the last sound entry, so that entries can be appended.
int journal_go_on(struct journal *j, struct error *e);

// Empties the journal and writes the head.
int journal_reset(struct journal *j, const char *head, struct error *e);

// Goes on with the runs of the open journal, or begins it anew, with this head. `noun` is what a
// message calls the study. Errors: STATUS_INPUT (it holds runs that the study does not have, or
// cannot be read), STATUS_SYSTEM.
int journal_resume(struct journal *j, const char *head, enum study_journal what, const char *noun,
                   struct error *e);

// Notes that all runs of this key that are not there are at a place of the caller's, > 0, which is
// then -offset. Returns false if the study has no such run.
bool journal_take(struct journal *j, const struct study_key *key, int64_t place, int status,
                  bool collapsed);

// Append an entry. A run stands for all runs of its key. Errors: STATUS_SYSTEM; the journal stays
// as it was.
int journal_add_run(struct journal *j, long run, const struct study_outcome *outcome,
                    bool collapsed, const double *value, struct error *e);
int journal_add_state(struct journal *j, const struct journal_state *state, struct error *e);
// The next `n` <= ENTRY_BLOCK_BYTES bytes of the histories of a run; journal_begin_run before the
// first ones.
void journal_begin_run(struct journal *j, long run);
int journal_add_block(struct journal *j, long run, const void *bytes, size_t n, struct error *e);

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
