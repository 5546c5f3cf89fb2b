// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/percentile.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

static const double CONFIDENCE = 0.95;

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

void percentile_interval(double *value, size_t n, double *low, double *high) {
    gsl_sort(value, 1, n);
    *low = n > 0 ? percentile_sorted(value, n, (1.0 - CONFIDENCE) / 2.0) : NAN;
    *high = n > 0 ? percentile_sorted(value, n, (1.0 + CONFIDENCE) / 2.0) : NAN;
}
