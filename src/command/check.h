// SPDX-License-Identifier: GPL-3.0-or-later
// What `check` says of the step.
#ifndef JOSTLE_CHECK_H
#define JOSTLE_CHECK_H

#include "command/deck_command.h"
#include "model/guidance.h"

// Prints how long contacts and periods are, how many of the model's steps cover them, and the step
// that resolves them.
void guidance_print(const struct model *m, const struct guidance *g);

// What `check` says of a study.

// Builds models of the study (study/survey.h): prints how many, the errors, and the advice on the
// step for the run that needs the smallest. Returns the exit status, EXIT_INPUT if a run has an
// error.
int check_study(const struct load_request *load, const struct model *first);

#endif
