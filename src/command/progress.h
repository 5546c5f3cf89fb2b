// SPDX-License-Identifier: GPL-3.0-or-later
// A line on a terminal that says how far a run is.
#ifndef JOSTLE_PROGRESS_H
#define JOSTLE_PROGRESS_H

#include <stdbool.h>

#include "jostle/error.h"

struct progress {
    double duration;   // of the analysis [T]
    const char *unit;  // of time
    bool enabled;      // stderr is a terminal
    bool shown;
    double start, last;  // wall time [s]
};

// A line for an analysis of `duration`; nothing is shown before one second has passed.
void progress_start(struct progress *p, double duration, const char *unit);
// The analysis has reached `time`.
void progress_show(struct progress *p, double time);
// The same with the duration, as the library tells it; `context` is the progress.
void progress_tell(void *context, long n_done, long n);
// The same after `n_done` runs; an error once a signal has come, STATUS_SYSTEM.
int progress_poll(void *context, long n_done, struct error *e);
// Takes the line away.
void progress_end(struct progress *p);

#endif
