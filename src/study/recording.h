// SPDX-License-Identifier: GPL-3.0-or-later
// The histories of the runs of a study on their way into its result file: from the journal, or, of
// a run that failed, up to its last row before the failure.
#ifndef JOSTLE_RECORDING_H
#define JOSTLE_RECORDING_H

#include "study/journal.h"
#include "study/plan.h"

struct record_cache;

// Everything is borrowed.
struct recording {
    const struct study_request *request;
    const struct plan *plan;
    struct journal *journal;
    struct record_cache *records;
    const struct study_progress *progress;  // that the poll of the request is called with
};

// Writes run `run` of the journal into a place of a result file. Of a run that failed before its
// second row nothing is written. Errors: STATUS_SYSTEM, and those of the poll.
int recording_write(const struct recording *r, long run, const struct result_place *place,
                    struct error *e);

#endif
