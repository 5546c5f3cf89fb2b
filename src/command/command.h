// SPDX-License-Identifier: GPL-3.0-or-later
// A command is one file of src/command/ and one line in command_list.inc. Only commands print.
#ifndef JOSTLE_COMMAND_H
#define JOSTLE_COMMAND_H

#include <getopt.h>
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

// Prints the usage, the summary and `details` to stdout; returns EXIT_DONE.
int command_help(const struct command *c, const char *details);

// Reads a whole number from 1 to `max`; `what` opens the message: "-j takes a number of threads".
// Returns EXIT_DONE or EXIT_INPUT.
int command_count(const struct command *c, const char *what, const char *text, long max,
                  long *value);

// The words of the command as one text; NULL: no memory.
struct arena;
const char *command_line(struct arena *a, int argc, char **argv);

// How a command reads its options.
struct command_options {
    const struct command *command;
    const char *details;          // of its help
    void (*print_details)(void);  // further ones; NULL: none
    // getopt_long, or getopt_long_only where one dash is enough for long options.
    int (*next)(int, char *const *, const char *, const struct option *, int *);
    const char *letters;          // for it, h too
    const struct option *option;  // for it
    // Takes an option other than -h, with optarg. Returns EXIT_DONE or, after a message, the exit
    // status.
    int (*take)(void *request, int letter);
    // Long name of the option with a value that may stand more than once; NULL: none.
    const char *repeatable;
};

// Reads the options, of which those with a value stand once; optind is then the first of the other
// words. Returns GO_ON, or the exit status after help or a message.
int command_parse(const struct command_options *o, int argc, char **argv, void *request);

// True if stderr may be coloured: it is a terminal and NO_COLOR is not set.
bool command_colour(void);

#endif
