// SPDX-License-Identifier: GPL-3.0-or-later
// Histories side by side, the time first, to be written into a script.
#ifndef JOSTLE_DATA_H
#define JOSTLE_DATA_H

#include "jostle/error.h"
#include "plot/canvas.h"

enum { DATA_COLUMNS_MAX = 8 };
struct data {
    size_t n_row;
    int n_column;
    double *column[DATA_COLUMNS_MAX];  // (n_row); owned, in one block
};

// Columns of zeros. Errors: STATUS_SYSTEM (no memory).
int data_create(struct data *d, long n_row, int n_column, struct error *e);
void data_free(struct data *d);

// Writes the data block $NAME, thinned so that each of `bins` equal parts keeps the extremes of
// every column. `heading` names the columns. Errors: STATUS_SYSTEM (no memory).
int data_write(const struct data *d, const char *name, const char *heading, size_t bins, FILE *to,
               struct error *e);

void data_span(const struct data *d, int column, struct span *r);

// The column's value at time t, by a straight line between rows.
double data_at(const struct data *d, int column, double t);

// The first row at t or later; n_row if there is none.
size_t data_row(const struct data *d, double t);

#endif
