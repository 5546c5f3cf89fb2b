// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_STUDY_END_H
#define JOSTLE_STUDY_END_H

#include "command/command.h"

// The exit status of a study whose file is written; says on stderr if runs have failed. `first` is
// the message of the first of them, "" where it is not known.
int study_end(long n_failed, long n_run, const char *path, const char *first);

#endif
