// SPDX-License-Identifier: GPL-3.0-or-later
// Laws bound to parameters given as text, and their isolated impacts.
#ifndef JOSTLE_TEST_IMPACT_H
#define JOSTLE_TEST_IMPACT_H

#include "jostle/contact_law.h"
#include "law/isolated.h"

// The values of the rows for parameters like "k 1e8 e 0.65"; fallbacks, or NAN, for the others.
void impact_values(const struct contact_law *law, const char *parameters, double *value);

// An isolated impact; fails the test where it does not end.
struct isolated_impact impact_of(const struct contact_law *law, const double *value, double mass,
                                 double velocity);
struct isolated_impact impact_under(const char *law, const char *parameters, double mass,
                                    double velocity);

#endif
