// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a picture by gnuplot from a script that the caller writes, and keeps the script on request.
#ifndef JOSTLE_PICTURE_H
#define JOSTLE_PICTURE_H

#include "command/command.h"
#include "jostle/result.h"
#include "plot/figure.h"

// What the user asks for.
struct picture_options {
    const char *output;         // ends in .png, .svg or .pdf; NULL: nothing is drawn
    const char *script_folder;  // made if it is not there; NULL: the script is not kept
    enum result_existing existing;
};

// Is there anything to make?
bool picture_is_wanted(const struct picture_options *o);

// Reports an output with another ending. Returns EXIT_DONE or EXIT_INPUT.
int picture_check(const struct command *c, const struct picture_options *o);

struct picture_request {
    struct picture_options options;
    const char *name;  // of the script and its data, NAME.gp and NAME.dat

    // Writes the script and its data; figure_open begins them. Write errors are not its own. It
    // may be called twice.
    int (*write)(void *context, const struct figure_files *to, struct error *e);
    void *context;
};

// Writes SCRIPT_FOLDER/NAME.gp and .dat, then runs gnuplot in a private folder and gives the
// complete picture its name. Errors: STATUS_INPUT (something exists, a name is too long),
// STATUS_SYSTEM (cannot write, gnuplot is missing or failed), or what `write` returns.
int picture_make(const struct picture_request *q, struct error *e);

#endif
