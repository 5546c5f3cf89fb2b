// SPDX-License-Identifier: GPL-3.0-or-later
// Fits parameters of the law of a storey, a hinge or a link to a measured loop: the shears at the
// measured drifts, which it follows from drift 0 without a history.
#ifndef JOSTLE_STOREY_FIT_H
#define JOSTLE_STOREY_FIT_H

#include <stddef.h>

#include "law/storey_loop.h"

enum { STOREY_FIT_STIFFNESS = -1 };  // in place of a row

struct storey_fit_request {
    const struct loop_law *law;
    const double *value;  // (law->n_row) of those rows that are not found; NAN: not given
    double stiffness;     // initial; NAN: it is found
    const int *row;       // (n_row) the rows that are found, or STOREY_FIT_STIFFNESS
    int n_row;
    size_t n;
    const double *drift, *shear;  // (n)
};

struct storey_fit_result {
    double value[LOOP_ROWS_MAX];  // of all rows
    double stiffness;
    double error[LOOP_ROWS_MAX + 1];  // standard errors of the rows that are found, in their order
    double normalised_error;
};

// Errors: STATUS_INPUT (too few samples, no shear), STATUS_FAILED (it does not converge),
// STATUS_SYSTEM.
int storey_fit_run(const struct storey_fit_request *request, struct storey_fit_result *out,
                   struct error *e);

#endif
