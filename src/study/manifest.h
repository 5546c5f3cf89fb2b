// SPDX-License-Identifier: GPL-3.0-or-later
// The files that the runs of a study read, with their checksums, so that no file changes while the
// study runs.
#ifndef JOSTLE_MANIFEST_H
#define JOSTLE_MANIFEST_H

#include <sys/stat.h>

#include "core/arena.h"
#include "jostle/deck.h"

struct manifest_file {
    const char *name;  // its path from the folder of the deck, or an absolute one, as the deck says
    const char *path;
    bool included;        // it is a deck
    struct checksum sum;  // "": it cannot be read
    struct stat seen;     // when the sum was made
    struct manifest_file *next;
};

struct manifest {
    struct arena *arena;  // owned
    const char *deck;     // path of the deck, borrowed
    size_t folder;        // bytes of it up to its last slash, and that
    struct manifest_file *file;
    long n_file;
};

// An empty manifest of the deck at this path. Errors: STATUS_SYSTEM (no memory).
int manifest_init(struct manifest *m, const char *deck, struct error *e);
void manifest_close(struct manifest *m);

// Enters a file that has no entry, as it is now; compares a file that has one with it. *entry is
// its entry. Errors: STATUS_INPUT (it has changed), STATUS_SYSTEM (no memory).
int manifest_check(struct manifest *m, const struct deck_path *file,
                   const struct manifest_file **entry, struct error *e);

// Enters the file of this name and compares it with `sum`. Errors: STATUS_INPUT with the name (the
// file has another checksum), STATUS_SYSTEM (no memory).
int manifest_expect(struct manifest *m, const char *name, const struct checksum *sum,
                    struct error *e);

#endif
