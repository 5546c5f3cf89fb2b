// SPDX-License-Identifier: GPL-3.0-or-later
// The files that the runs of a study have read, so that none changes while it runs or between its
// start and its resumption.
#ifndef JOSTLE_LEDGER_H
#define JOSTLE_LEDGER_H

#include <sys/stat.h>

#include "core/arena.h"
#include "jostle/deck.h"

struct ledger_file {
    const char *path;
    bool included;        // it is a deck
    struct checksum sum;  // "": it cannot be read
    struct stat seen;     // when the sum was made
    bool changed;         // since its last ledger_expect
    struct ledger_file *next;
};

struct ledger {
    struct arena *arena;  // owned
    struct ledger_file *file;
};

// Errors: STATUS_SYSTEM (no memory).
int ledger_init(struct ledger *l, struct error *e);
void ledger_close(struct ledger *l);

// Enters a file that is new as it is now; *added is its entry. One that has been entered is
// compared with its entry; *added is NULL. Errors: STATUS_INPUT (it has changed), STATUS_SYSTEM (no
// memory).
int ledger_check(struct ledger *l, const struct deck_path *file, const struct ledger_file **added,
                 struct error *e);

// Enters a file and notes whether it has another checksum than `sum`. Of a file that is expected
// twice the last one counts. Errors: STATUS_SYSTEM (no memory).
int ledger_expect(struct ledger *l, const char *path, const struct checksum *sum, struct error *e);

// STATUS_INPUT if a file has changed: the first one that was expected.
int ledger_unchanged(const struct ledger *l, struct error *e);

#endif
