// SPDX-License-Identifier: GPL-3.0-or-later
// What commands on one deck have in common: their command line, `DECK [-D NAME=VALUE]...` and
// options of their own, and the model that they do something with.
#ifndef JOSTLE_DECK_COMMAND_H
#define JOSTLE_DECK_COMMAND_H

#include "command/load.h"

// Rows of their tables of options.
#define DECK_COMMAND_OPTIONS                                                                       \
    {"define", required_argument, NULL, 'D'}, {"help", no_argument, NULL, 'h'}, {                  \
        NULL, 0, NULL, 0                                                                           \
    }

// Help on these alone.
extern const char deck_command_details[];

// Functions get the `options` of deck_command_run, and return EXIT_DONE or, after a message, the
// exit status.
struct deck_command {
    const struct command *command;
    const char *details;                     // the options, for its help
    const char *letters;                     // as of getopt_long, -D and -h too
    const struct option *option;             // likewise
    int (*take)(void *options, int letter);  // takes an option of its own, with optarg; or NULL
    int (*settle)(void *options);            // when all options are known; or NULL
    int (*use)(void *options, const struct model *m);
};

// Runs the command. `load`, a part of `options`, is filled from the command line. Returns the exit
// status.
int deck_command_run(const struct deck_command *c, int argc, char **argv, struct load_request *load,
                     void *options);

#endif
