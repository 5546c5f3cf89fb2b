// SPDX-License-Identifier: GPL-3.0-or-later
// Scale factors that fit ground motions to a target spectrum.
#ifndef JOSTLE_MOTION_MATCH_H
#define JOSTLE_MOTION_MATCH_H

#include "jostle/error.h"
#include "jostle/spectrum.h"

struct arena;

// A period, and the mean of the scaled spectra divided by the target there.
struct match_ratio {
    double period, value;
};

struct match {
    double *factor;                     // (n_record)
    double *misfit;                     // (n_record) root of the mean of ln(f PSA / target)^2
    struct match_ratio least, largest;  // over all periods compared
};

// Compares the spectra of unscaled records, of the first damping ratio, with the target's values
// `goal` (n_period) at their periods. Every PSA is > 0. Errors: STATUS_SYSTEM (no memory).
int match_compute(struct match *m, const struct spectra *s, const double *goal, struct arena *a,
                  struct error *e);

#endif
