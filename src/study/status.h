// SPDX-License-Identifier: GPL-3.0-or-later
// How far studies are: what their journals and files say, without a lock, so that a program that
// writes them is not disturbed.
#ifndef JOSTLE_STATUS_H
#define JOSTLE_STATUS_H

#include "study/journal.h"

enum study_stage { STAGE_COMPLETE, STAGE_RUNNING, STAGE_STOPPED };

struct status_found {
    enum study_stage stage;
    struct journal_state state;  // its counts; seconds_left NaN: not known
};

// The journal at `path`. A study runs if its last state is younger than STATUS_AGE seconds and does
// not say that it has ended. An entry that is being written, and what is behind a damaged one, does
// not count. Errors: STATUS_INPUT (no journal), STATUS_SYSTEM; they name the path.
enum { STATUS_AGE = 15 };
int status_of_journal(const char *path, struct status_found *out, struct error *e);

// The study file at `path`. Errors as of study_file_open.
int status_of_file(const char *path, struct status_found *out, struct error *e);

#endif
