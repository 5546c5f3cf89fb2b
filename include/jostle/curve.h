// SPDX-License-Identifier: GPL-3.0-or-later
// A measured curve of force against penetration, with a branch of loading and one of unloading.
#ifndef JOSTLE_CURVE_H
#define JOSTLE_CURVE_H

#include "jostle/names.h"

JOSTLE_C_BEGIN

// Numbers of one point.
enum curve_column { CURVE_PENETRATION, CURVE_LOADING, CURVE_UNLOADING, CURVE_COLUMNS };

// Points from (0, 0, 0) on. The penetration grows. The loading force does not decrease and ends
// above 0. The ratio of unloading to loading force is between 0 and 1, does not decrease, and ends
// at 1.
struct curve {
    int n;                // at least 2
    const double *point;  // (n, CURVE_COLUMNS)
};

JOSTLE_C_END

#endif
