// SPDX-License-Identifier: GPL-3.0-or-later
// The spring of Hertz, k d^n, shared by the laws built on it.
#ifndef JOSTLE_POWER_H
#define JOSTLE_POWER_H

#include <math.h>

#include "jostle/contact_law.h"

// Exponents of contact laws: 1 (flat faces) to 3.
extern const struct range power_range;

// The row of k in F / L^n, where n is the value of the row with ROW_POWER.
#define POWER_STIFFNESS_ROW(doc)                                                                   \
    { "k", ROW_NUMBER, ROW_REQUIRED | ROW_PER_LENGTH_POWER, OF_FORCE, &range_positive, NAN, doc }

// k d^n and its slope for d >= 0; dfdv is 0. For n = 3/2 it uses a square root instead of pow. It
// is inline because it takes most of the time of the contact iteration.
static inline struct contact_response power_spring(double k, double n, double d) {
    double slope = k * (n == 1.5 ? sqrt(d) : pow(d, n - 1.0));
    return (struct contact_response){.force = slope * d, .dfdd = n * slope};
}

#endif
