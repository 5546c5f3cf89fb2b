// SPDX-License-Identifier: GPL-3.0-or-later
// Reads square matrices from files.
#ifndef JOSTLE_MOTION_MATRIX_FILE_H
#define JOSTLE_MOTION_MATRIX_FILE_H

#include "jostle/error.h"

struct arena;

struct matrix_request {
    const char *path;
    int n;             // rows and columns that are needed
    const char *of;    // what needs them, for messages: "building A"
    const char *unit;  // of the values, for messages
    double from, to;   // that unit and the one wanted
};

// Reads a stiffness matrix, rows separated by line ends, which must be symmetric to rounding and
// positive definite; *value is (n, n) from `a`, symmetric. Errors: STATUS_INPUT with the path and
// the cause, and the line and column where there is one; STATUS_SYSTEM when the file cannot be read
// or memory runs out.
int matrix_read(struct arena *a, const struct matrix_request *request, double **value,
                struct error *e);

#endif
