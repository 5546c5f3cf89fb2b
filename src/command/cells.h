// SPDX-License-Identifier: GPL-3.0-or-later
// Tables for other programs, cell by cell: separated by tabs, or by commas with quotes after RFC
// 4180 (lines end with a line feed alone).
#ifndef JOSTLE_CELLS_H
#define JOSTLE_CELLS_H

#include <stdbool.h>
#include <stdio.h>

enum cells_form { CELLS_TSV, CELLS_CSV, CELLS_JSON };
struct cells {
    FILE *to;
    enum cells_form form;
    bool within;  // a line
    long n_line;  // before it
};

// safe_put writes the texts. JSON is {"columns": [names], "data": [[cells], ...]}, where empty
// cells, NaN and infinities are null; the first line has the names.
void cells_text(struct cells *c, const char *text);
void cells_number(struct cells *c, double value);  // the shortest that is read as it again, or nan
void cells_numbers(struct cells *c, const double *value, int n);
void cells_empty(struct cells *c);
void cells_whole(struct cells *c, long value);
void cells_sign(struct cells *c, int value);  // an empty cell for values below 0
void cells_end(struct cells *c);
void cells_close(struct cells *c);  // after the last line

// A cell for each of the words, which are separated by blanks: the head of a table.
void cells_words(struct cells *c, const char *words);

#endif
