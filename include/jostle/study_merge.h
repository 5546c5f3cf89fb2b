// SPDX-License-Identifier: GPL-3.0-or-later
// A study in parts: which runs a part has, and the parts joined to one file.
#ifndef JOSTLE_STUDY_MERGE_H
#define JOSTLE_STUDY_MERGE_H

#include "jostle/names.h"
#include "jostle/study_file.h"

JOSTLE_C_BEGIN

// How many of the `n_run` runs of a study a part has, and the number, from 0, of its run `i`.
//
// Runs are dealt out in rows of n, one to each part, and each row begins one part later than the
// row before: part k has run k - q mod n of row q. Without that shift a part would have the same
// value of the last sweep in all its runs where n divides their number: all of the
// strongest records to one part.
long study_shard_size(const struct study_shard *s, long n_run);
long study_shard_run(const struct study_shard *s, long i);

struct study_merge_request {
    const char *const *path;  // (n_path) files of parts
    int n_path;
    enum study_gaps { STUDY_WHOLE, STUDY_PARTIAL } gaps;  // may runs be missing?
    struct result_options result;

    // Called now and then. A result other than 0 ends the merge with that status, and nothing is
    // written.
    int (*poll)(void *context, struct error *e);

    // Called with the part that is read from now on, and with NULL while the result is written. The
    // last call names the part that is closed last. NULL: nobody is told.
    void (*reading)(void *context, const char *path);
    void *context;
};

struct study_merged {
    long n_run, n_failed, n_missing;
    bool left_histories;  // parts have histories, which the file does not
    char missing[256];    // which: "parts 3, 7-9 of 16", or "runs 3, 5-8 of 40"
};

// Joins parts to the file of the whole study, whose datasets are those of a study run as a whole,
// to the last bit. Any division will do, and runs may be in several parts. With STUDY_PARTIAL runs
// may be missing: STUDY_MISSING, NaN. Memory grows with the number of parts, and by 41 bytes for
// each run. Errors: STATUS_FAILED (runs are missing), STATUS_INPUT (no parts, or of different
// studies; the file exists), STATUS_SYSTEM, or what `poll` returned.
int study_merge(const struct study_merge_request *q, struct study_merged *out, struct error *e);

JOSTLE_C_END

#endif
