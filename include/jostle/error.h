// SPDX-License-Identifier: GPL-3.0-or-later
// Errors are values. The lowest function that knows the cause writes the text once, callers pass it
// up unchanged, and only the program prints it.
#ifndef JOSTLE_ERROR_H
#define JOSTLE_ERROR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "jostle/names.h"

JOSTLE_C_BEGIN

// Result of a function that can fail: 0 success, > 0 recoverable (try a smaller step), < 0 final.
enum status {
    STATUS_OK = 0,
    STATUS_RETRY = 1,     // try again: a step is rejected, the committed state is untouched
    STATUS_COLLAPSE = 2,  // a storey has passed its limit of drift, at which the run ends
    STATUS_FAILED = -1,   // the analysis failed: exit status 1
    STATUS_INPUT = -2,    // wrong usage, deck or record: exit status 2
    STATUS_SYSTEM = -3,   // no memory, cannot read or write: exit status 3
};

// One message: a single line, lower case, no full stop, naming the offending value and the limit.
struct error {
    int status;
    char message[512];
};

// Writes the message into `e` (cut to fit) and returns `status`.
int error_set(struct error *e, int status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// error_set with "out of memory" and STATUS_SYSTEM.
int error_no_memory(struct error *e);

enum severity { SEVERITY_ERROR, SEVERITY_WARNING };

// A message that points at a place in a text file.
struct diagnostic {
    enum severity severity;
    const char *file;         // as the user named it
    int line;                 // from 1; 0: no place
    int column;               // in characters, from 1
    int width;                // characters to underline
    const char *source_line;  // text of the line, up to 0 or a line feed; NULL: not shown
    int source_first;         // column of its first character; 0 and 1: the line is not cut
    const char *message;
};

struct arena;

// All that is wrong with a deck, in the order found. Beyond DIAGNOSTICS_MAX only the count grows.
enum { DIAGNOSTICS_MAX = 100 };
struct diagnostics {
    struct arena *arena;  // borrowed: texts are copied into it
    struct diagnostic *item;
    int n_item;
    int n_error;    // all errors, kept or not
    int n_warning;  // all warnings, kept or not
    bool out_of_memory;
    bool system;  // an error is the system's (STATUS_SYSTEM), not that of what was read
};

// Makes `d` empty; its texts will be from `arena`.
void diagnostics_init(struct diagnostics *d, struct arena *arena);

// Appends a copy of `entry`, whose message is made from `format`. Long lines are cut around the
// column, and what a terminal might obey is replaced. Never fails: a lack of memory is remembered
// in `out_of_memory` and counts as an error.
void diagnostics_add(struct diagnostics *d, const struct diagnostic *entry, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Remembers a lack of memory, which counts as one error.
void diagnostics_no_memory(struct diagnostics *d);

// What was wrong with what was read, as the one error `e`, which says so far that something was:
// `file:line:column: message` of the first error (`-D NAME=VALUE: message` of a -D), and
// STATUS_SYSTEM if the system is to blame. Returns its status.
int diagnostics_cause(const struct diagnostics *d, struct error *e);

// Writes `file:line:column: error: message`, the source line and a caret line for each entry, with
// ANSI colours if `colour`.
void diagnostics_print(const struct diagnostics *d, FILE *to, bool colour);

JOSTLE_C_END

#endif
