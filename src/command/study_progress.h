// SPDX-License-Identifier: GPL-3.0-or-later
// How far a study is: on a terminal one line that is written over, elsewhere a line every ten
// seconds.
#ifndef JOSTLE_STUDY_PROGRESS_H
#define JOSTLE_STUDY_PROGRESS_H

#include "command/command.h"
#include "jostle/study.h"

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
int study_end(long n_failed, long n_run, const char *path, const char *first);

#endif
