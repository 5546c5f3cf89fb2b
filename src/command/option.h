// SPDX-License-Identifier: GPL-3.0-or-later
// Options of a command as rows. From the rows come the tables of getopt_long, which finds the
// options on the command line, the messages, and the help; man page and completion follow from the
// help.
#ifndef JOSTLE_OPTION_H
#define JOSTLE_OPTION_H

#include <stddef.h>

#include "command/command.h"

struct arena;

// What an option takes, and where in the request of its command that goes.
enum option_kind {
    OPTION_TRUE,    // no value; bool
    OPTION_SET,     // no value; int or enum, which becomes `set`. Options of one place exclude each
                    // other
    OPTION_TEXT,    // const char *; of options of one place one is given
    OPTION_WORDS,   // struct words; may be repeated
    OPTION_WHOLE,   // int from `least` to `most`
    OPTION_NUMBER,  // double from `least` to `most`
    OPTION_CHOICE,  // int or enum: which of the words of `value`, "above|left-out", it is
    OPTION_OWN,     // what own() makes of it
    OPTION_HELP,    // prints the help
};

// Flags: what the help shows of an option with a letter and a long name; 0: both.
enum { OPTION_LETTER_ONLY = 1, OPTION_NAME_ONLY = 2 };

struct option_row {
    const char *name;   // without dashes
    char letter;        // 0: none
    const char *value;  // what stands for it in the help, "FILE"; NULL: it takes no value
    enum option_kind kind;
    unsigned flags;
    size_t at;           // the place in the request, or in the part of it that part.at says
    double least, most;  // of numbers
    const char *what;  // of whole numbers, in messages: "a number of runs"; NULL: "a whole number"
    int set;
    // Lists that it makes are from the arena. EXIT_DONE or, after a message, the exit status.
    int (*own)(void *request, struct arena *a, const char *text);
    const char *doc;  // of the help, which wraps it
};

// Several values of an option, or the words that are neither options nor their values.
struct words {
    const char **word;  // (n)
    int n;
};

// The help consists of parts: rows, a text with its own line ends, or what a function prints.
struct option_part {
    const struct option_row *row;  // ends in {0}
    const char *text;
    void (*print)(void);
    size_t at;     // of rows: where the struct that they are for begins in the request
    size_t first;  // of rows: where the first row that was given goes, const struct option_row *;
                   // 0: nowhere
};

struct option_list {
    const struct command *command;
    const struct option_part *part;  // ends in {0}
    // DASH_ONE: long names may have one dash, too. DASH_LAW: words with one dash are operands.
    enum { DASH_TWO, DASH_ONE, DASH_LAW } dash;
    const char *operand;  // "deck", of which one is expected; NULL: any number of anything
    // Does the work. Lists of the request live as long as the arena. Returns the exit status.
    int (*use)(void *request, struct arena *a, const struct words *operand);
};

// The row of --help, for parts.
extern const struct option_row option_help[];

// Reads the command line into the request, and calls use(). Returns the exit status.
int option_run(const struct option_list *l, int argc, char **argv, void *request);

// Prints a text that begins in column `column`, in lines of at most `width` columns. Further lines
// are indented as far.
void option_wrap(const char *text, int column, int width);

// Reads the text as a whole number within the limits of the row. Returns EXIT_DONE or EXIT_INPUT.
int option_whole(const struct command *c, const struct option_row *r, const char *text, int *value);

#endif
