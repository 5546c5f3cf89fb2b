// SPDX-License-Identifier: GPL-3.0-or-later
// The bootstrap of a fragility: how far its median and dispersion scatter if the units of the suite
// are drawn again, with replacement, and the curve is fitted anew (Efron & Tibshirani 1993, An
// Introduction to the Bootstrap, chapters 6 and 13: intervals between percentiles).
#ifndef JOSTLE_BOOTSTRAP_H
#define JOSTLE_BOOTSTRAP_H

#include "study/fragility.h"

enum { BOOTSTRAP_SEED = 1, BOOTSTRAP_MAX = 1000000 };

struct bootstrap_request {
    int n_unit;
    const int *stratum;  // (n_unit) rising; each unit is replaced by one of its own stratum; NULL:
                         // there is one stratum
    int n_draw;
    int seed;
    // Fits the units, of which unit i counts weight[i] times.
    int (*fit)(void *context, const int *weight, struct fragility *out, struct error *e);
    void *context;
};

// Between the 2.5 and 97.5 % of the fits. Draws from which no curve follows are left out.
struct bootstrap {
    int n_draw, n_fitted;
    double median[2], dispersion[2];  // low, high; NAN: nothing was fitted
};

// The result depends on the request only. Errors: STATUS_SYSTEM (no memory), those of `fit` but
// STATUS_FAILED, which is a draw without a curve.
int bootstrap_run(const struct bootstrap_request *q, struct bootstrap *out, struct error *e);

// First exceedances as units: a `fit` of the request, whose context this is. weight NULL: each
// counts once.
struct bootstrap_records {
    const struct fragility_record *record;  // (n)
    int n;
    struct fragility_record *drawn;  // (n) room
};
int bootstrap_fit_records(void *context, const int *weight, struct fragility *out, struct error *e);

#endif
