// SPDX-License-Identifier: GPL-3.0-or-later
// jostle law --over: impacts for a list of velocities, restitutions or stiffnesses.
#ifndef JOSTLE_LAW_OVER_H
#define JOSTLE_LAW_OVER_H

#include "command/law_words.h"
#include "command/picture.h"
#include "command/printer.h"

struct law_over_request {
    struct law_words words;
    const char *text;  // "v=0.1,0.2,0.5" or "v=FROM:TO:N"
    struct picture_options picture;
    enum printer_form form;
};

// Runs all impacts, draws the forces and prints a line for each. Returns the exit status.
int law_over_run(const struct law_over_request *q);

#endif
