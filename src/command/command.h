// SPDX-License-Identifier: GPL-3.0-or-later
// A command is one file of src/command/ and one line in command_list.inc. Only commands print.
#ifndef JOSTLE_COMMAND_H
#define JOSTLE_COMMAND_H

#include <stdbool.h>
#include <stdio.h>

#include "jostle/error.h"

// Exit status of the program. GO_ON: none yet, there is something left to do.
enum { GO_ON = -1, EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_INPUT = 2, EXIT_SYSTEM = 3 };

struct command {
    const char *name;
    const char *usage;                  // after "jostle NAME ": "FILE.h5 [--tsv|--json]"
    const char *summary;                // half a line
    int (*run)(int argc, char **argv);  // argv[0] is the command's name; returns the exit status
};

extern const struct command *const commands[];
extern const int n_command;

// Prints "jostle: error: ..." to stderr; returns the exit status for e->status.
int command_fail(const struct error *e);

// command_fail, because there is no memory.
int command_no_memory(void);

// Prints "jostle NAME: error: ..." and where help is; returns EXIT_INPUT.
int command_usage(const struct command *c, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// "unknown WHAT 'WORD'", with the nearest of the `n` known ones; returns EXIT_INPUT.
int command_unknown(const struct command *c, const char *what, const char *word,
                    const char *const *known, int n);

// The words of the command as one text; NULL: no memory.
struct arena;
const char *command_line(struct arena *a, int argc, char **argv);

// True if stderr may be coloured: it is a terminal and NO_COLOR is not set.
bool command_colour(void);

#endif
