// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of the variance (Sobol 2001, Math. Comput. Simul. 55, 271-280). There are two samples of
// all parameters, A and B. A row has a run with the values of A, one with those of B, and one for
// each parameter i with the values of A but that of B for i, AB_i. With f less its mean, and V its
// variance over A and B:
//     first order: mean of f_B (f_AB_i - f_A) / V          (Saltelli et al. 2010, table 2 (b),
//     total:       mean of (f_A - f_AB_i)^2 / (2 V)         Comput. Phys. Commun. 181, 259-270)
// The same runs give elementary effects (f_AB_i - f_A) / (p_B - p_A) (Campolongo, Saltelli &
// Cariboni 2011, Comput. Phys. Commun. 182, 978-988), p being the probability of a smaller value.
#ifndef JOSTLE_SOBOL_H
#define JOSTLE_SOBOL_H

#include <stddef.h>

#include "jostle/error.h"

enum { SOBOL_A, SOBOL_B, SOBOL_PARAMETER };  // columns; one for each parameter from the last on

struct sobol_runs {
    size_t n;  // rows
    int n_parameter;
    const double *demand;  // (n, n_parameter + 2); a row with one that is not finite is left out
    const double *step;    // (n_parameter, n) p_B - p_A
};

enum { SOBOL_BOOTSTRAPS = 1000 };

// An index and the interval in which it is with a confidence of 95 %, by 1000 bootstraps of the
// rows.
struct sobol_index {
    double value, low, high;
};

struct sobol_share {
    struct sobol_index first;  // the share of the variance that is due to the parameter alone
    struct sobol_index total;  // the share that is left where all other parameters are known
    // Mean of the absolute elementary effects, and standard deviation of the effects: how much the
    // demand changes from the smallest to the largest value of the parameter.
    double effect, scatter;
};

struct sobol_summary {
    double mean, deviation;  // of the demand, over A and B
    size_t n_left_out;       // rows
};

// Fills `share` (n_parameter). Errors: STATUS_FAILED (fewer than two rows), STATUS_SYSTEM.
int sobol_find(const struct sobol_runs *runs, struct sobol_share *share, struct sobol_summary *out,
               struct error *e);

#endif
