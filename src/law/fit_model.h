// SPDX-License-Identifier: GPL-3.0-or-later
// The force of an isolated impact at the samples of a record, shared by the files of the fit.
#ifndef JOSTLE_FIT_MODEL_H
#define JOSTLE_FIT_MODEL_H

#include "law/fit.h"

// A point in the space of what is fitted.
struct fit_point {
    double k, zeta, start;  // zeta is not used where the law has none
};

// The samples from `first` up to `end`, without it.
struct fit_samples {
    size_t first, end;
};

struct fit_model {
    const struct fit_request *q;
    bool damped;                        // the law has a zeta
    bool jumps_closing, jumps_opening;  // the force does, where the search starts
    double value[CONTACT_ROWS_MAX];     // of the law's rows
    double peak;                        // largest force of the record

    // (n) at the samples; filled by fit_model_predict.
    double *time;          // since closure
    double *force, *rate;  // of the impact; 0 outside the contact
    struct fit_samples contact;
    struct isolated_point closure, opening;
};

// Errors: STATUS_INPUT (no k, a record without a pulse), STATUS_SYSTEM. fit_model_free in any case.
int fit_model_init(const struct fit_request *q, struct fit_model *m, struct error *e);
void fit_model_free(struct fit_model *m);

// An impact with the parameters of `p`; `observer` may be NULL.
int fit_model_impact(struct fit_model *m, const struct fit_point *p,
                     const struct isolated_observer *observer, struct isolated_impact *out,
                     struct error *e);

// Force and rate at the samples. Bodies that do not part have no force that could fit: 0. With
// `held`, those samples count as in contact: beyond closure and opening the force goes on with its
// rate there. Where the force jumps at the start, the samples on both sides of the jump take what
// was measured, so that they are left out, also where a search makes the jump as small as rounding.
void fit_model_predict(struct fit_model *m, const struct fit_point *p,
                       const struct fit_samples *held);

// The sum of the squares of what fit_model_predict is off by, where none are held.
double fit_model_squares(struct fit_model *m, const struct fit_point *p);

// Notes where the force last predicted jumps, at closure or opening; true if it does.
bool fit_model_note_jumps(struct fit_model *m);

// Sets `restitution` and `cut` of the result. Errors: STATUS_INPUT (the impulse of the record, the
// effective mass and the approach velocity imply a restitution beyond 0 and 1; the record begins or
// ends at its peak).
int fit_check_impulse(const struct fit_model *m, struct fit_result *out, struct error *e);

// A point from which the search can start, and the duration of its impact. Errors: STATUS_FAILED.
int fit_start(struct fit_model *m, struct fit_point *p, double *duration, struct error *e);

#endif
