// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_PLOT_STUDY_H
#define JOSTLE_PLOT_STUDY_H

#include "command/picture.h"
#include "command/suite_options.h"

struct plot_study_request {
    const struct command *command;
    const char *path;  // the study
    const char *kind;  // NULL: what shows it best
    struct suite_options *options;
    struct picture_options picture;
};

// Draws a figure of a study and prints the name of the picture. Returns the exit status.
int plot_study(const struct plot_study_request *q);

// The kinds, for the help.
void plot_study_print_kinds(void);

#endif
