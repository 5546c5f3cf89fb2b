// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_SHOW_STUDY_H
#define JOSTLE_SHOW_STUDY_H

#include <stdio.h>

#include "jostle/error.h"

enum study_form { STUDY_SUMMARY, STUDY_TSV };

// Writes what the study file at `path` holds: its sweeps, failures and largest values, or a table
// of all values, a line each. Errors as of study_file_open and study_file_read.
int show_study(const char *path, enum study_form form, FILE *to, struct error *e);

#endif
