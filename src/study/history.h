// SPDX-License-Identifier: GPL-3.0-or-later
// The histories of a run on their way into the journal and out of it: their shape, then the rows
// that the result file is to hold, as an observer sees them, then the results. Numbers are as they
// are in memory.
#ifndef JOSTLE_HISTORY_H
#define JOSTLE_HISTORY_H

#include "jostle/analysis.h"
#include "study/journal_entry.h"

// Tells another number of rows, and rows of another size, with other fields or at other times, from
// those of runs of this model. Not 0.
uint64_t history_shape(const struct model *m);

// Being written: a block at a time goes to `put`.
struct history_writer {
    int (*put)(void *context, const void *bytes, size_t n, struct error *e);
    void *context;
    const struct model *model;  // borrowed; of the run
    size_t used;                // bytes of `block`
    unsigned char block[ENTRY_BLOCK_BYTES];
};

// Begins the histories of a run of this model; `put` and `context` stay.
void history_start(struct history_writer *w, const struct model *m);

// Adds a row; adds the results and hands over what is left. Errors: those of `put`.
int history_put_row(struct history_writer *w, const struct row_view *row, struct error *e);
int history_put_results(struct history_writer *w, const struct results *r, struct error *e);

// Shows the rows of run `run` of the journal, whose model is `m`, to an observer, as analysis_run
// did. *out must be given to results_free. Errors: STATUS_SYSTEM (no memory, a damaged journal, the
// histories of another model), those of the observer.
int history_replay(struct journal *j, long run, const struct model *m,
                   const struct observer *observer, struct results **out, struct error *e);

#endif
