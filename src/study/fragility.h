// SPDX-License-Identifier: GPL-3.0-or-later
// Fragility, lognormal but where it says so: the probability that a demand exceeds a limit at the
// intensity x,
//     P(x) = Phi(ln(x / theta) / beta),
// with the median theta and the dispersion beta of largest likelihood.
#ifndef JOSTLE_FRAGILITY_H
#define JOSTLE_FRAGILITY_H

#include <stdbool.h>

#include "jostle/error.h"

// Of `n` runs at an intensity, `exceeded` were above the limit.
struct fragility_level {
    double intensity;
    int n, exceeded;
};

// Counts from which no such curve follows have no parameters.
enum fragility_outcome {
    FRAGILITY_FITTED,
    FRAGILITY_NO_RUNS,
    FRAGILITY_NONE_EXCEEDS,
    FRAGILITY_ALL_EXCEED,
    FRAGILITY_SEPARATED,  // all below some intensity stay under the limit, all above exceed it
    FRAGILITY_ONE_LEVEL,
    FRAGILITY_FALLS,         // exceedance does not grow with the intensity
    FRAGILITY_NOT_POSITIVE,  // an intensity is <= 0 and has no logarithm
    FRAGILITY_FEW,           // fewer than two records have a first exceedance
    FRAGILITY_NO_SPREAD,     // these are at one intensity
    FRAGILITY_NO_LOGARITHM,  // a demand is not > 0; of cloud_fit, as those below
    FRAGILITY_FEW_RUNS,      // fewer than three runs have a finite demand, or one intensity
    FRAGILITY_NO_SCATTER,    // their demands lie on the line
    FRAGILITY_NO_LOGIT,      // all runs that collapse are above all others
};

struct fragility {
    enum fragility_outcome outcome;
    double median, dispersion;
    double log_median_error, dispersion_error;  // standard errors of ln theta and of beta
    // Separated: the highest intensity with runs below the limit, and the lowest with runs above
    // it; they are equal where one intensity has both.
    double between[2];
    // Of a cloud with collapses: the curve is not lognormal, and median and dispersion are only its
    // quantiles. The probability of collapse has the logit logit[0] + logit[1] ln x; the runs that
    // do not collapse have a lognormal curve of their own.
    bool mixed;
    double logit[2], standing_median, standing_dispersion;
};

// Maximum likelihood over counts of exceedance, Baker (2015), Earthquake Spectra 31(1), 579-599,
// eq. 11. Errors: STATUS_SYSTEM (no memory), STATUS_FAILED (the iteration does not converge).
int fragility_fit(const struct fragility_level *level, int n, struct fragility *out,
                  struct error *e);

// Where a record first exceeds the limit: at an intensity, or above or below all that it was run
// at.
enum fragility_crossing { CROSSING_AT, CROSSING_ABOVE, CROSSING_BELOW, CROSSING_NO_RUNS };
struct fragility_record {
    enum fragility_crossing crossing;
    double intensity;  // the crossing, or the highest or lowest intensity of the record
};

// From the first exceedances of `n` records. Errors: as fragility_fit.
int fragility_fit_records(const struct fragility_record *record, int n, struct fragility *out,
                          struct error *e);

// P(x) of what was fitted.
double fragility_probability(const struct fragility *f, double intensity);

// Half a sentence that says why nothing was fitted; "" where it was.
const char *fragility_reason(const struct fragility *f);

#endif
