// SPDX-License-Identifier: GPL-3.0-or-later
// A script of commands, in Python (a module in place of an interpreter's commands) or in Tcl. The
// commands and their arguments are said once, and printed in the language of the script.
#ifndef JOSTLE_EXPORT_EMIT_H
#define JOSTLE_EXPORT_EMIT_H

#include <stddef.h>
#include <stdio.h>

enum emit_language { EMIT_PYTHON, EMIT_TCL };

struct emitter {
    FILE *to;  // borrowed; write errors are the caller's
    enum emit_language language;
    int indent;  // blocks that are open
};

// Writes the first lines of a script. `module`: the module of Python, a literal.
void emit_start(const struct emitter *s, const char *module);

// Writes a command. `form` has a letter for each argument: `w` a word, a literal of the program;
// `i` an int; `n` a double, which is written so that it is read back as it is.
void emit_put(const struct emitter *s, const char *name, const char *form, ...);

// The same in parts, for commands with many arguments.
void emit_begin(const struct emitter *s, const char *name);
void emit_word(const struct emitter *s, int place, const char *word);
void emit_whole(const struct emitter *s, int place, int value);
void emit_number(const struct emitter *s, int place, double value);
void emit_numbers(const struct emitter *s, int place, const double *value, size_t n);  // a list
void emit_end(const struct emitter *s);

// A command that the commands up to emit_close belong to: `pattern Plain TAG SERIES`.
void emit_pattern(struct emitter *s, int tag, int series);
void emit_close(struct emitter *s);

// A command whose result must be 0: else the script ends with this message, a literal.
void emit_must(const struct emitter *s, const char *name, int count, double value,
               const char *message);

// A line of comment, composed as by printf. Texts in it may be foreign: they cannot end the line.
// Not within emit_pattern, where Tcl counts the braces of comments, too.
void emit_note(const struct emitter *s, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
