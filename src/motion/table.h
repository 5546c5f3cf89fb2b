// SPDX-License-Identifier: GPL-3.0-or-later
// Files of numbers in rows: the first row, the numbers of rows and columns, and the text above.
#ifndef JOSTLE_MOTION_TABLE_H
#define JOSTLE_MOTION_TABLE_H

#include "motion/lines.h"
#include "motion/record_format.h"

// The first row is the first line in which every field begins like a number. Blank lines and
// comments do not count. Commas and semicolons separate values. But commas are decimal commas if
// semicolons separate the values of every row, no number has a point, and the commas cannot
// separate thousands.
struct table {
    const char *separators;  // characters that separate values
    bool comma;              // numbers have decimal commas
    struct lines rows;       // the current line is the one before the first row
    int first_line;          // of the first row
    struct piece caption;    // last line above the rows that is not blank, without comment signs
    int caption_line;        // 0: there is no caption; the caption is empty
    struct piece stars;      // first line of an overflow below the caption; empty: there is none
    int stars_line;
    bool framed;      // a line of overflow is also above the caption
    size_t n_column;  // fields of the first row
    size_t n_row;     // all rows
    size_t n_last;    // fields of the last row
    size_t n_ragged;  // rows, without the last, with another number of fields
};

// Finds the rows; false: the file has no line of numbers.
bool table_find(const struct record_text *t, struct table *out);

// Finds the rows, and refuses a file without them or that would be misread. Reasons: the caption is
// a row with an unreadable value or an overflow, unless lines of stars frame it; a comment is
// between the rows; decimal commas are next to other separators.
int table_read(const struct record_text *t, struct table *table, struct error *e);

// Goes to the next row; false at the end.
bool table_next(struct lines *rows);

// Reads a field of the table as lines_read_number does.
int table_number(const struct table *table, const struct number_field *f, double *value,
                 struct error *e);

// The time step in s that a line above the rows gives, as in `dt = 0.02 s`, and its line; 0: none.
double table_noted_step(const struct record_text *t, const struct table *table, int *line);

#endif
