// SPDX-License-Identifier: GPL-3.0-or-later
// Kinks and jumps of the forces of closed contacts, where d and v are not 0 both.
#ifndef JOSTLE_DP_KINK_H
#define JOSTLE_DP_KINK_H

#include "solve/dormand_prince/dp.h"

// The first kink in the step of the force of closed contact k, whose law has any, or `other` if
// that is earlier.
struct dp_event dp_kink_before(const struct dp *p, int k, struct dp_event other);

// How far the end of the step is before the kink, and the rate of that.
double dp_kink_at_end(const struct dp *p, int k, double *rate);

// Has the velocity of closed contact k, now on the other branch, come to 0 where its force jumps,
// so that either branch leads back there?
bool dp_kink_sticks(struct dp *p, int k);

#endif
