// SPDX-License-Identifier: GPL-3.0-or-later
// The force of an isolated impact at the samples of a record, shared by the files of the fit.
#ifndef JOSTLE_FIT_MODEL_H
#define JOSTLE_FIT_MODEL_H

#include "law/fit.h"

// Values of the fitted parameters.
struct fit_point {
    double k, zeta, start;  // zeta is ignored if the law has none
};

// The samples from `first` up to `end`, without it.
struct fit_samples {
    size_t first, end;
};

struct fit_model {
    const struct fit_request *q;
    bool damped;                        // the law has a zeta
    bool jumps_closing, jumps_opening;  // the force jumps at the start of the search
    double value[CONTACT_ROWS_MAX];     // values of the law's rows
    double peak;                        // largest force of the record

    // (n) values at the samples; fit_model_predict sets them.
    double *time;          // since closure
    double *force, *rate;  // force and its rate; 0 outside the contact
    struct fit_samples contact;
    struct isolated_point closure, opening;
};

// Prepares the model. Call fit_model_free afterwards, also after an error. Errors: STATUS_INPUT
// (the law has no k, or the record has no pulse), STATUS_SYSTEM.
int fit_model_init(const struct fit_request *q, struct fit_model *m, struct error *e);
void fit_model_free(struct fit_model *m);

// Computes an impact with the parameters `p`; `observer` may be NULL.
int fit_model_impact(struct fit_model *m, const struct fit_point *p,
                     const struct isolated_observer *observer, struct isolated_impact *out,
                     struct error *e);

// Computes force and rate at the samples. If the bodies do not separate, the forces are 0. The
// samples of `held` count as in contact: before closure and after opening the force continues with
// its rate. If the force jumps, the two samples on both sides of the jump get the measured values,
// so that they do not count in the fit. The start of the search decides this, even if the jump
// becomes small later.
void fit_model_predict(struct fit_model *m, const struct fit_point *p,
                       const struct fit_samples *held);

// The sum of the squared errors of fit_model_predict, without held samples.
double fit_model_squares(struct fit_model *m, const struct fit_point *p);

// Notes whether the last predicted force jumps at closure or at opening; true if it does.
bool fit_model_note_jumps(struct fit_model *m);

// Sets `restitution` and `cut` of the result. Errors: STATUS_INPUT (the impulse of the record, the
// effective mass and the approach velocity give a restitution outside 0 to 1; the record begins or
// ends at its peak).
int fit_check_impulse(const struct fit_model *m, struct fit_result *out, struct error *e);

// Finds the start of the search and the duration of its impact. Errors: STATUS_FAILED.
int fit_start(struct fit_model *m, struct fit_point *p, double *duration, struct error *e);

#endif
