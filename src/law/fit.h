// SPDX-License-Identifier: GPL-3.0-or-later
// Fits stiffness and damping of a contact law to the measured force of one isolated impact.
#ifndef JOSTLE_FIT_H
#define JOSTLE_FIT_H

#include "law/isolated.h"

struct fit_request {
    const struct contact_law *law;
    const double *value;    // (law->n_row) of its rows; those of k, e and zeta are not read
    double mass, velocity;  // effective mass, approach velocity
    size_t n;
    const double *time, *force;  // (n) the record: ascending, compression positive
};

// A parameter and its standard error.
struct fit_parameter {
    double value, error;
};

struct fit_result {
    struct fit_parameter k;
    struct fit_parameter zeta;   // NAN: the law has none
    struct fit_parameter start;  // [T] instant of closure on the clock of the record
    double normalised_error;     // ||measured - fitted|| / ||measured|| over the samples
};

// Finds k, zeta and the instant of closure by least squares. Errors: STATUS_INPUT (the record does
// not hold an impact), STATUS_FAILED (no convergence), STATUS_SYSTEM (no memory).
int fit_run(const struct fit_request *request, struct fit_result *out, struct error *e);

#endif
