// SPDX-License-Identifier: GPL-3.0-or-later
// Largest values within steps of Dormand & Prince's method.
#ifndef JOSTLE_DP_PEAKS_H
#define JOSTLE_DP_PEAKS_H

#include "solve/dormand_prince/dp.h"

// Those of the step, within it and at its end.
void dp_peaks_step(struct dp *p);

// Those at `now` after a jump, for when it lasts or is shown: between events at one instant there
// are velocities and accelerations that nobody has for any time.
void dp_peaks_jump(struct dp *p);

// Force and penetration in the step of link number i of the active ones, into its peaks and into
// `share`.
void dp_peaks_link(struct dp *p, int i, struct impact_share *share);

#endif
