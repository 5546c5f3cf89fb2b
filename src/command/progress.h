// SPDX-License-Identifier: GPL-3.0-or-later
// Lines on stderr that say how far an analysis or a study is.
#ifndef JOSTLE_PROGRESS_H
#define JOSTLE_PROGRESS_H

#include <stdbool.h>

#include "jostle/error.h"
#include "jostle/study.h"

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

enum display { DISPLAY_NOTHING, DISPLAY_PROGRESS };

struct study_display {
    enum display display;
    bool terminal;  // stderr is one
    bool shown;
    double start, last;  // wall time [s]
};

// How far a study is: a line on a terminal that is written over twice a second, and taken away at
// the end; elsewhere a line every ten seconds, which stays.
void study_display_start(struct study_display *d, enum display display);
void study_display_show(struct study_display *d, const struct study_progress *p);
void study_display_end(struct study_display *d);

// The exit status of a study whose file is written; says on stderr if runs have failed. `first` is
// the message of the first of them, "" where it is not known.
int study_display_status(long n_failed, long n_run, const char *path, const char *first);

#endif
