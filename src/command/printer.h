// SPDX-License-Identifier: GPL-3.0-or-later
// One printer for all tables: text in columns for readers; for programs cells separated by tabs, or
// by commas with quotes after RFC 4180 (lines end with a line feed alone), or JSON,
// {"columns": [names], "data": [[cells], ...]}. Columns come first, then the head, then the cells
// line by line. safe_put writes the texts.
#ifndef JOSTLE_PRINTER_H
#define JOSTLE_PRINTER_H

#include <stdbool.h>
#include <stdio.h>

#include "command/option.h"
#include "jostle/deck.h"

enum printer_form { FORM_TEXT, FORM_TSV, FORM_CSV, FORM_JSON };  // the last three are data

// How text shows a number: as %.*g, %.*f, %.*e or by printer_read; and a name: whole, or by
// safe_cell, which keeps the end of a long one.
enum printer_look { LOOK_G, LOOK_F, LOOK_E, LOOK_READ, LOOK_TAIL, LOOK_WHOLE = 0 };

struct printer_column {
    const char *head;                   // over the column of text; NULL: it is not in text
    const char *key;                    // its name in data; NULL: it is not in data
    const char *unit;                   // stands with the name; "": none; NULL: that of `dimension`
    const struct dimension *dimension;  // NULL: none
    int width;  // of text; 0 and below: aligned at the left, with two blanks before it
    int digits;
    enum printer_look look;
};

// Columns of text and columns of data.
#define COLUMN_NAME(name, wide)                                                                    \
    { .head = name, .width = -(wide), .look = LOOK_TAIL }
#define COLUMN_TEXT(name, wide)                                                                    \
    { .head = name, .width = wide }
#define COLUMN_G(name, wide, figures)                                                              \
    { .head = name, .width = wide, .digits = figures }
#define COLUMN_F(name, wide, figures)                                                              \
    { .head = name, .width = wide, .digits = figures, .look = LOOK_F }
#define COLUMN_DATA(name)                                                                          \
    { .key = name }
#define COLUMN_OF(name, of)                                                                        \
    { .key = name, .dimension = &(of) }

// Where text has the units: behind the heads, or below them, there in brackets or bare. Data has
// them behind the names.
enum printer_units { UNITS_BEHIND, UNITS_BELOW, UNITS_BELOW_BARE };

struct printer {
    FILE *to;
    enum printer_form form;
    const struct unit_system *units;  // of the dimensions
    enum printer_units at_head;
    int indent;  // blanks before a line of text
    // The printer's own.
    struct printer_column *column;  // (n_column) heap
    int n_column, capacity;
    int at, n_shown;  // the next cell of the line; how many were printed
    int blanks;       // of text: those due before the next character
    long n_line;
    bool failed;  // there was no memory for a column
};

#define PRINTER_ADD(t, columns) printer_add(t, columns, (int)(sizeof(columns) / sizeof(columns)[0]))
void printer_add(struct printer *t, const struct printer_column *column, int n);
void printer_head(struct printer *t);

// The next cell of a line. Nothing is printed where its column is not of this form.
void printer_text(struct printer *t, const char *text);
void printer_number(struct printer *t, double value);  // data: the shortest that is read as it
                                                       // again; NaN is '-', nan, or null in JSON
void printer_numbers(struct printer *t, const double *value, int n);
void printer_whole(struct printer *t, long value);
void printer_sign(struct printer *t, int value);  // an empty cell for values below 0
void printer_empty(struct printer *t);            // null in JSON

// A number as readers like it, with so many digits: those of five or six before the point are
// whole, with no power of ten to be read. NaN is '-'.
void printer_read(double value, int digits, char *text, size_t size);

// Ends a line. Cells that are left are empty.
void printer_line(struct printer *t);

// Ends the table. Returns EXIT_DONE or, after a message, the exit status.
int printer_close(struct printer *t);

// The same for functions whose errors are values: returns `status`, or STATUS_SYSTEM.
int printer_end(struct printer *t, int status, struct error *e);

// Columns of data and cells of a sweep, and of what goes together along it: its value `choice`.
void printer_add_sweep(struct printer *t, const struct sweep *sweep);
// The same, with columns of text, too.
void printer_show_sweep(struct printer *t, const struct sweep *sweep);
void printer_sweep(struct printer *t, const struct sweep *sweep, int choice);

// The options --csv and --json, of an enum printer_form. They stand behind a row of --tsv, whose
// text says what the table is.
extern const struct option_row printer_rows[];

#endif
