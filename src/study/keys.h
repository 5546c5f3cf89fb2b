// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of the runs of a study. A key is the SHA-256 of all that the results of a run depend on:
// the statements of the deck with the values of their parameters, the contents of the files that
// they name, and the version of the numerics. Runs of one key have the same results to the last
// bit, whatever study they belong to and whatever their number is in it.
#ifndef JOSTLE_KEYS_H
#define JOSTLE_KEYS_H

#include "study/manifest.h"
#include "study/plan.h"

struct keys {
    long n;                 // runs
    struct study_key *key;  // (n)
    int *slot;              // (n_slot) hash table: the first run of each key, from 1; 0: empty
    size_t n_slot;          // a power of 2
    int *twin;              // (n) the next run of the same key; -1: none
};

// keys_open makes room for `n` keys, which are not known yet. keys_index makes the table, once they
// are filled in. Call keys_close, whatever happens. Errors: STATUS_SYSTEM (no memory).
int keys_open(struct keys *k, long n, struct error *e);
void keys_index(struct keys *k);

// Does both, with the keys of the runs of the plan. Enters in the manifest the files that the runs
// read. Errors: STATUS_INPUT (a file changes meanwhile), STATUS_SYSTEM, and those of the poll of
// `q`.
int keys_make(struct keys *k, const struct study_request *q, const struct plan *p,
              struct manifest *m, struct error *e);
void keys_close(struct keys *k);

// The first run of this key; -1: there is none, or the key is not known.
long keys_find(const struct keys *k, const struct study_key *key);

// From now on the key of the run is not known: the run read a file that its key does not contain.
void keys_forget(struct keys *k, long run);

bool keys_is_known(const struct study_key *key);

#endif
