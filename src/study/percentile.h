// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef JOSTLE_PERCENTILE_H
#define JOSTLE_PERCENTILE_H

#include <stddef.h>

// The quantile at `fraction`, 0 to 1, of the `n` >= 1 ascending values, interpolated linearly
// between the two around it (definition 7 of Hyndman and Fan 1996, The American Statistician 50,
// 361; that of numpy and of spreadsheets). Values may end with infinities, which stand for
// whatever is above all others: where one of them would count, the quantile is infinite.
double percentile_sorted(const double *value, size_t n, double fraction);

// The interval that holds the middle 95 % of the `n` values, which are sorted; NAN: n is 0.
void percentile_interval(double *value, size_t n, double *low, double *high);

#endif
