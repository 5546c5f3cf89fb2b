// SPDX-License-Identifier: GPL-3.0-or-later
// Files of numbers in rows: where the numbers begin, how many there are, and what stands above.
#ifndef JOSTLE_MOTION_TABLE_H
#define JOSTLE_MOTION_TABLE_H

#include "motion/lines.h"
#include "motion/record_format.h"

// The rows are the lines from the first on in which every field begins like a number; blank lines
// and comments do not count. Commas and semicolons separate values; where semicolons do so in every
// row, no number has a point, and the commas cannot be those of thousands, they are decimal commas.
struct table {
    const char *separators;  // of values
    bool comma;              // numbers have decimal commas
    struct lines rows;       // stands on the line before the first row
    int first_line;          // of the first row
    struct piece caption;    // last line above it that is not blank, without comment signs
    int caption_line;        // 0: there is none, the caption is empty
    struct piece stars;      // first line of an overflow below the caption; no text: there is none
    int stars_line;
    bool framed;      // such a line also stands above the caption
    size_t n_column;  // fields of the first row
    size_t n_row;     // all rows
    size_t n_last;    // fields of the last row
    size_t n_ragged;  // rows other than the last with another number of fields
};

// False: no line of numbers.
bool table_find(const struct record_text *t, struct table *out);

// Goes to the next row; false at the end.
bool table_next(struct lines *rows);

// lines_read_number of a field of the table.
int table_number(const struct table *table, const struct number_field *f, double *value,
                 struct error *e);

// The time step in s that a line above the rows gives, as in `dt = 0.02 s`, and its line; 0: none.
double table_noted_step(const struct record_text *t, const struct table *table, int *line);

// Refuses what would be misread: a first row taken for a caption because of an unreadable value or
// an overflow, unless lines of stars frame the caption; comments between the rows; and commas
// beside other separators, which are decimal commas.
int table_check(const struct record_text *t, const struct table *table, struct error *e);

#endif
