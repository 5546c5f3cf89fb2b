// SPDX-License-Identifier: GPL-3.0-or-later
// Files of one or two columns with units: a quantity over time or over the period, a force over a
// deformation.
#ifndef JOSTLE_MOTION_TIME_SERIES_H
#define JOSTLE_MOTION_TIME_SERIES_H

#include <stddef.h>

#include "jostle/error.h"
#include "jostle/row.h"

struct arena;

enum { TIME_SERIES_COLUMNS = 2 };
struct time_series_column {
    const char *name;  // in messages: "time", "value"
    struct dimension dimension;
    double unit;                // in SI, if the caption gives no unit; 0: the caption must give it
    const struct range *range;  // NULL: any number
};

struct time_series {
    size_t n;
    const double *time;   // (n) [s] ascending
    const double *value;  // (n) in SI
};

// Reads `n` columns, one or two of different dimensions, separated by spaces, tabs, commas or
// semicolons, into the arena: value[c] (*n_row) in SI. The last line above the numbers may give
// units in brackets: `time [ms], force [kN]`. Errors: STATUS_INPUT with "path:line: cause" or
// "path:line:column: cause", STATUS_SYSTEM.
int time_series_columns(struct arena *a, const char *path, const struct time_series_column *column,
                        int n, const double **value, size_t *n_row, struct error *e);

// The same for two columns, the first of which must ascend.
int time_series_read(struct arena *a, const char *path,
                     const struct time_series_column column[TIME_SERIES_COLUMNS],
                     struct time_series *out, struct error *e);

// Reads the time and the numbers beside it, n_column in all, without units, into the arena:
// *value (n_column, *n_row). Times must ascend. Errors: as of time_series_columns.
int time_series_matrix(struct arena *a, const char *path, int n_column, const double **value,
                       size_t *n_row, struct error *e);

#endif
