// SPDX-License-Identifier: GPL-3.0-or-later
// Comparisons of the inner loops, where a call of fmax costs more than the rest. Not for NaN.
#ifndef JOSTLE_NUMBER_H
#define JOSTLE_NUMBER_H

static inline double number_max(double a, double b) {
    return a > b ? a : b;
}

#endif
