// SPDX-License-Identifier: GPL-3.0-or-later
// What a result at ever shorter steps says of its own error.
#ifndef JOSTLE_CONVERGENCE_H
#define JOSTLE_CONVERGENCE_H

#include <stdbool.h>

enum { CONVERGENCE_LEVELS_MIN = 3, CONVERGENCE_LEVELS_MAX = 16 };

enum convergence_kind {
    CONVERGENCE_NONE,       // nothing changes beyond rounding
    CONVERGENCE_ORDERLY,    // towards a limit, at an order that can be believed
    CONVERGENCE_FAST,       // towards a limit faster than the method can: partly by chance
    CONVERGENCE_IRREGULAR,  // back and forth, or by growing differences
    CONVERGENCE_COUNT,      // whole numbers, the last two equal
    CONVERGENCE_MISCOUNT,   // whole numbers, the last two different
};

struct convergence {
    enum convergence_kind kind;
    double order;     // observed; NAN: there is none
    double estimate;  // of the limit: by Richardson, or the value at the shortest step
    double error;     // half the width of the error bar at the shortest step
};

// Of the last three of n >= 3 values at steps h, h / ratio, h / ratio^2 ..., ratio > 1, by a method
// of the given order. `safety`: the error bar over the error estimated at an order.
struct convergence convergence_of(const double *value, int n, double ratio, double order,
                                  double safety);

// Of a number of things, of which n >= 2 are given.
struct convergence convergence_of_count(const double *value, int n);

// Whether the error bar is within `rtol` of the value at the shortest step; a miscount is not.
// `value` is that one.
bool convergence_is_within(const struct convergence *c, double value, double rtol);

#endif
