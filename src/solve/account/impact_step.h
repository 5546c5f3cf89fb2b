// SPDX-License-Identifier: GPL-3.0-or-later
// What a step adds to a link and to its impact, written once for the lane counts of core/masks.h:
// one link of one run (impacts.c), and one contact of eight runs (ensemble_sweeps.c).
#ifndef JOSTLE_IMPACT_STEP_H
#define JOSTLE_IMPACT_STEP_H

#include "core/masks.h"

#ifdef LANES_OF_RUNS
#define IMPACT_SHARE struct impact_share_lanes
#define IMPACT_LINK struct link_peak_lanes
#define IMPACT struct impact_lanes
#else
#include "solve/account/account.h"

#define IMPACT_SHARE struct impact_share
#define IMPACT_LINK struct link_peak
#define IMPACT struct impact
#endif

// The share of a step of length h, in which the force goes from f0 to f1 and the penetration from
// d0 to d1, by the trapezoidal rule.
LANE_INLINE void impact_find_share(const lane_number *f0, const lane_number *f1,
                                   const lane_number *d0, const lane_number *d1, double h,
                                   IMPACT_SHARE *share) {
    const lane_number mean = (*f0 + *f1) / 2.0;
    share->impulse = mean * h;
    share->work = mean * (*d1 - *d0);
    share->force = *f1;
    share->penetration = *d1;
}

// Adds it to the totals of the link, and to its impact. NULL: none is under way.
LANE_INLINE void impact_add_share(IMPACT_LINK *link, IMPACT *impact, const IMPACT_SHARE *share) {
    link->impulse += share->impulse;
    link->dissipated += share->work;
    if (impact) {
        impact->impulse += share->impulse;
        impact->dissipated += share->work;
        impact->peak_force = LARGER(impact->peak_force, share->force);
        impact->max_penetration = LARGER(impact->max_penetration, share->penetration);
    }
}

#endif
