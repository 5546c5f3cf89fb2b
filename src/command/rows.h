// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of statements and laws as tables, and the pieces that the reference pages of `laws` and
// `deck` share. Everything goes to stdout.
#ifndef JOSTLE_ROWS_H
#define JOSTLE_ROWS_H

#include "command/option.h"
#include "jostle/row.h"

// Plain text of at most 100 columns, or Markdown.
enum page { PAGE_TEXT, PAGE_MARKDOWN };

// A table of the rows: option, unit, range, default, meaning. Units and defaults are in SI. The
// Markdown table is without the rows for which `left_out` is true (NULL: it has all rows).
void rows_print(enum page page, const struct row *row, int n_row,
                bool (*left_out)(const struct row *row));

// One line of the Markdown page with the options for which `named` is true, without their meaning.
void rows_names(const struct row *row, int n_row, bool (*named)(const struct row *row));

// "label: text", wrapped in plain text. `text` NULL: prints nothing.
void rows_entry(enum page page, const char *label, const char *text);

// The same for text that is to be typed literally: a usage, a formula.
void rows_code(enum page page, const char *label, const char *text);

// The same on one line, however long: what is copied to be run.
void rows_example(enum page page, const char *text);

// A heading of the given depth, from 1.
void rows_heading(enum page page, int depth, const char *text);

// What both pages open with: that they are generated, and by what.
void rows_generated(const char *command);

// The command line `[NAME] [--markdown]`. `print` gets it, `name` NULL where it is not given, and
// returns the exit status, as this does.
int rows_command(const struct command *c, int argc, char **argv,
                 int (*print)(enum page page, const char *name));

#endif
