// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra of building codes, as texts such as "en1998:ground=C,ag=0.25g". A code is a const
// descriptor: its rows are read, refused and documented by the same functions.
#ifndef JOSTLE_MOTION_TARGET_CODE_H
#define JOSTLE_MOTION_TARGET_CODE_H

#include <stdbool.h>

#include "jostle/error.h"
#include "jostle/row.h"

enum { TARGET_CODE_ROWS_MAX = 8 };

// A parameter of a spectrum: a number, or one of the words of its range.
struct target_row {
    struct row row;
    double bare;  // [SI] the unit of a number without one; 0: a unit is required
};

struct target_code {
    const char *name, *title;  // "en1998", "EN 1998-1:2004"
    const char *example;
    const struct target_row *row;  // (n)
    int n;
    double last;  // [s] the spectrum is defined from 0 to here
    bool damped;  // it is defined for other damping ratios than 5 %
    // Completes the values (n) [SI] for the damping ratio; a row that was not given is its
    // fallback. Returns a fault for messages, or NULL.
    const char *(*settle)(double *value, double damping);
    double (*at)(const double *value, double period);  // [m/s^2]
};

extern const struct target_code *const target_codes[];
extern const int n_target_code;

// The code that a text begins with; NULL: the text names a file.
const struct target_code *target_code_find(const char *text);

// Appends the names of all codes to the message of an error; returns its status.
int target_code_hint(struct error *e);

// Reads "NAME:KEY=VALUE,..." into `value` (TARGET_CODE_ROWS_MAX). Errors: STATUS_INPUT.
int target_code_read(const struct target_code *c, const char *text, double damping, double *value,
                     struct error *e);

#endif
