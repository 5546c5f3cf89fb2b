// SPDX-License-Identifier: GPL-3.0-or-later
// Laws bound to parameters given as text, and their isolated impacts.
#ifndef JOSTLE_TEST_IMPACT_H
#define JOSTLE_TEST_IMPACT_H

#include "jostle/contact_law.h"
#include "law/isolated.h"

// A pad that hardens, with a residual penetration: d, loading and unloading force.
enum { PAD_POINTS = 5, PAD_NUMBERS = PAD_POINTS * CURVE_COLUMNS };
extern const double pad[PAD_NUMBERS];

// Room for the values and constants of any law, that of a curve through the points of the pad too.
enum {
    IMPACT_VALUES_MAX = CONTACT_ROWS_MAX + PAD_NUMBERS,
    IMPACT_CONSTANTS_MAX = CONTACT_CONSTANTS_MAX + PAD_NUMBERS
};

// The law of this name, and the values of its rows for parameters like "k 1e8 e 0.65"; fallbacks,
// or NAN, for the others, and the pad for a curve.
const struct contact_law *impact_law(const char *name, const char *parameters, double *value);

// A law with its constants, closed at some velocity: its force, and a step to (d, v).
struct bound_law {
    const struct contact_law *law;
    double constant[IMPACT_CONSTANTS_MAX];
    double history[CONTACT_HISTORY_MAX];
};
struct bound_law bound_law(const struct contact_law *law, const double *value, double mass,
                           double v0);
struct contact_response bound_at(const struct bound_law *b, double d, double v);
void bound_commit(struct bound_law *b, double d, double v);

// An isolated impact; fails the test where it does not end.
struct isolated_impact impact_of(const struct contact_law *law, const double *value, double mass,
                                 double velocity);
struct isolated_impact impact_under(const char *law, const char *parameters, double mass,
                                    double velocity);

#endif
