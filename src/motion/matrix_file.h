// SPDX-License-Identifier: GPL-3.0-or-later
// Reads square matrices from files.
#ifndef JOSTLE_MOTION_MATRIX_FILE_H
#define JOSTLE_MOTION_MATRIX_FILE_H

#include "jostle/error.h"

struct arena;

struct matrix_request {
    const char *path;
    int n;             // required number of rows and columns
    const char *of;    // the owner of the matrix, for messages: "building A"
    const char *unit;  // of the values, for messages
    double from, to;   // unit of the file and unit of the result
};

// Reads a stiffness matrix, rows separated by line ends, which must be symmetric to rounding and
// positive definite; *value is (n, n) from `a`, symmetric. Errors: STATUS_INPUT with the path and
// the cause, and the line and column if known; STATUS_SYSTEM: the file cannot be read, no
// memory.
int matrix_read(struct arena *a, const struct matrix_request *request, double **value,
                struct error *e);

#endif
