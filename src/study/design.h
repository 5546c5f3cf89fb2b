// SPDX-License-Identifier: GPL-3.0-or-later
// Designs of a sensitivity analysis: which value each parameter has in which run. A set gives each
// parameter one of `n_level` values, and each combination of the other sweeps has a run of a set.
//
// - One at a time: set 0 has all medians. Sets 1 + 2 i and 2 + 2 i have the two quantiles of
//   parameter i.
// - Variance: rows of two samples A and B, as sobol.h says. The samples are the two halves of the
//   points of one Sobol' sequence in 2 d dimensions. A random vector shifts the points (Cranley &
//   Patterson 1976, SIAM J. Numer. Anal. 13, 904-914), so that no step from A to B is 0. GSL's
//   sequence has 40 dimensions; beyond d = 20 the points are random.
// - Morris: trajectories, as morris.h says, between the quantiles `share` and 1 - share.
#ifndef JOSTLE_DESIGN_H
#define JOSTLE_DESIGN_H

#include "study/morris.h"
#include "study/sensitivity.h"

struct design {
    const struct sensitivity_request *request;
    const struct sensitivity *of;
    long n_set;
    int n_level;
    double *u, *value;  // (n_parameter, n_level) probability of a smaller value; the value
    struct morris_design morris;  // of Morris
};

long design_count_sets(const struct sensitivity_request *q, const struct sensitivity *s);

// Memory is from `a`. Errors: STATUS_INPUT (a quantile is not finite), STATUS_SYSTEM.
int design_init(struct design *d, const struct sensitivity_request *q, const struct sensitivity *s,
                struct arena *a, struct error *e);

// Where `u` and `value` have what parameter `i` is in set `set`.
size_t design_at(const struct design *d, long set, int i);

#endif
