// SPDX-License-Identifier: GPL-3.0-or-later
// A measured quantity over time, from a file of two columns; the steps need not be even.
#ifndef JOSTLE_MOTION_TIME_SERIES_H
#define JOSTLE_MOTION_TIME_SERIES_H

#include <stddef.h>

#include "jostle/error.h"
#include "jostle/units.h"

struct arena;

struct time_series {
    size_t n;
    const double *time;   // (n) [s] ascending
    const double *value;  // (n) in SI
};

// Reads time and a value of `dimension`, separated by blanks, tabs, commas or semicolons. Numbers
// are in SI unless the last line above them gives units in brackets: `time [ms], force [kN]`.
// Errors: STATUS_INPUT with "path:line: cause", STATUS_SYSTEM.
int time_series_read(struct arena *a, const char *path, struct dimension dimension,
                     struct time_series *out, struct error *e);

#endif
