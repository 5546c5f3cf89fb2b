// SPDX-License-Identifier: GPL-3.0-or-later
// Fits stiffness and damping of a contact law to the measured force of one isolated impact.
#ifndef JOSTLE_FIT_H
#define JOSTLE_FIT_H

#include "law/isolated.h"

struct fit_request {
    const struct contact_law *law;
    const double *value;    // (law->n_row) values of its rows; those of k, e and zeta are ignored
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
    struct fit_parameter zeta;   // NAN: the law has no zeta
    struct fit_parameter start;  // [T] instant of closure on the clock of the record
    double normalised_error;     // ||measured - fitted|| / ||measured|| over the samples
    double restitution;          // computed from the impulse of the record and m v
    double cut;  // if an end of the record cuts the impact off: the force there divided by the
                 // peak; the restitution is then too small. 0: the record has the whole impact
};

// True if the record does not determine a parameter: its standard error exceeds its value. False
// for a parameter that the law does not have.
bool fit_is_undetermined(const struct fit_parameter *p);

// Finds k, zeta and the instant of closure by least squares. Errors: STATUS_INPUT (the record has
// no impact, or its impulse contradicts mass and velocity), STATUS_FAILED (no
// convergence), STATUS_SYSTEM (no memory).
int fit_run(const struct fit_request *request, struct fit_result *out, struct error *e);

#endif
