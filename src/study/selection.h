// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a study file that a user chooses.
#ifndef JOSTLE_SELECTION_H
#define JOSTLE_SELECTION_H

#include "jostle/study_file.h"

// How a text chooses runs.
#define SELECTION_FORM "N, N-M, failed, collapsed, worst:N or worst:N:EDP"

// Marks the rows of the file that `text` chooses in `chosen` (n_run of the file): a list of the
// forms above, separated by commas. N and M are numbers of runs in the study. worst:10:force are
// the ten runs with the largest force, and EDP is the usual demand if it is not given. Runs that
// collapsed have the largest demands of buildings. Errors: STATUS_INPUT (another text, a run that
// the file does not have, no such demand), STATUS_SYSTEM.
int selection_read(struct study_file *f, const char *text, unsigned char *chosen, struct error *e);

// Checks such a text before there is a file. Errors as of selection_read.
int selection_check(const struct study_view *v, const char *text, struct error *e);

#endif
