// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/percentile.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>

double percentile_sorted(const double *value, size_t n, double fraction) {
    size_t finite = n;
    while (finite > 0 && !isfinite(value[finite - 1])) {
        finite--;
    }
    // The place among the values is (n - 1) fraction; on a finite value it does not matter what is
    // above.
    const double place = fraction * (double)(n - 1);
    if (finite == n) {
        return gsl_stats_quantile_from_sorted_data(value, 1, n, fraction);
    }
    if (finite == 0 || place > (double)(finite - 1)) {
        return INFINITY;
    }
    return gsl_stats_quantile_from_sorted_data(value, 1, finite,
                                               finite > 1 ? place / (double)(finite - 1) : 0.0);
}
