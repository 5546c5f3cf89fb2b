// SPDX-License-Identifier: GPL-3.0-or-later
// Cloud analysis: the demands of runs at any intensities, such as records that are not scaled. The
// logarithm of the demand is a straight line over that of the intensity, with a normal scatter
// (Cornell et al. 2002, J. Struct. Eng. 128, 526-533). Runs that collapsed have no demand; their
// probability is a logistic function of the logarithm of the intensity (Jalayer et al. 2017,
// Earthquake Engng Struct. Dyn. 46, 2639-2663).
#ifndef JOSTLE_CLOUD_H
#define JOSTLE_CLOUD_H

#include "study/fragility_runs.h"

struct cloud {
    int n, n_collapsed;       // runs with a finite demand, and above all values
    double intercept, slope;  // ln demand = intercept + slope ln intensity
    double scatter;           // standard deviation of ln demand about the line, with n - 2
    struct fragility fit;     // of the limit
};

// A unit counts weight[unit] times; NULL: once. A demand that is the collapse itself (`collapses`)
// has no line, only the logit. The curve has no standard errors. Errors: STATUS_FAILED (the
// iteration does not converge).
int cloud_fit(const struct fragility_runs *r, const int *weight, double limit, bool collapses,
              struct cloud *out, struct error *e);

#endif
