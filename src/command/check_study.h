// SPDX-License-Identifier: GPL-3.0-or-later
// What `check` says of a study.
#ifndef JOSTLE_CHECK_STUDY_H
#define JOSTLE_CHECK_STUDY_H

#include "command/load.h"

// Builds models of the study (study/survey.h): prints how many, the errors, and the advice on the
// step for the run that needs the smallest. Returns the exit status, EXIT_INPUT if a run has an
// error.
int check_study(const struct load_request *load, const struct model *first);

#endif
