// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares over samples: finds the unknowns x for which
//
//     sum over i of (measured_i - value_i(x))^2 = min
//
// by the trust-region method of Levenberg and Marquardt (GSL).
#ifndef JOSTLE_LEAST_SQUARES_H
#define JOSTLE_LEAST_SQUARES_H

#include <stdbool.h>
#include <stddef.h>

#include "jostle/error.h"

enum { LEAST_SQUARES_UNKNOWNS = 24 };

// The start value of each unknown. It is not 0, so that changes are relative. A change of 1 should
// be a large one.
extern const double least_squares_origin;

struct least_squares {
    const char *name;  // of what is fitted, for messages
    size_t n;          // samples
    int n_unknown;
    const double *measured;  // (n)
    double scale;            // their largest size

    // Sets the values (n) at the samples for unknowns x (n_unknown).
    void (*predict)(void *context, const double *x, double *value);

    // Sets the derivatives (n) with respect to unknown u; false: they follow from central
    // differences. NULL: all do.
    bool (*derivative)(void *context, const double *x, int u, double *column);
    void *context;

    struct least_squares_memory *memory;  // its own
};

struct least_squares_result {
    double x[LEAST_SQUARES_UNKNOWNS];
    double error[LEAST_SQUARES_UNKNOWNS];  // standard errors, if the residuals are white noise
    double normalised_error;               // root of the sum of squares over that of values of 0
};

// Allocates for searches; close it afterwards, also after an error. Errors: STATUS_SYSTEM.
int least_squares_open(struct least_squares *l, struct error *e);
void least_squares_close(struct least_squares *l);

// One search from least_squares_origin. Errors: STATUS_FAILED: it does not converge.
int least_squares_search(struct least_squares *l, struct least_squares_result *out,
                         struct error *e);

#endif
