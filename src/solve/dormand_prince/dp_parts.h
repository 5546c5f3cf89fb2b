// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings with parts in a step of Dormand & Prince's method. Parts are evaluated as they are,
// from the history at the start of the step: kinks and turns are not located, but left to the error
// control.
#ifndef JOSTLE_DP_PARTS_H
#define JOSTLE_DP_PARTS_H

#include "solve/dormand_prince/dp.h"

// Adds what the parts of building `g` do to the accelerations and powers of `r`.
void dp_parts_add(const struct dp_system *s, const struct state *now, const struct building *g,
                  struct dp_rates *r);

// Brings the histories of parts to the drifts and velocities of `now`.
void dp_parts_commit(const struct dp_system *s, struct state *now);

// The error of the step over the tolerance by turns of parts with a history within it, which the
// stages do not see: the history at the end depends on the way there.
double dp_parts_error(const struct dp *p);

// The largest storey shears of buildings with parts in the step.
void dp_parts_peaks(struct dp *p);

#endif
