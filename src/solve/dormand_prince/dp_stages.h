// SPDX-License-Identifier: GPL-3.0-or-later
// A step by the stages of Dormand & Prince's method.
#ifndef JOSTLE_DP_STAGES_H
#define JOSTLE_DP_STAGES_H

#include "solve/dormand_prince/dp.h"

// Makes the first stage, at `now`, where it is not the last of the step before.
void dp_stages_first(struct dp *p);

// Takes the step from `now` of length h to time `end` into `next`.
void dp_stages_take(struct dp *p, double h, double end);

// The estimated error of that step over the tolerance.
double dp_stages_error(const struct dp *p);

// Penetrations of all links of state `s` and their rates.
void dp_stages_gaps(const struct dp *p, struct state *s, double *rate);

// Integral over the step, up to the place x in it, of what has the values f at the stages: h sum
// b_i(x) f_i; and over the whole of it.
void dp_stages_weights(double x, double *weight);
extern const double dp_stages_whole[DP_STAGES];

// Adds the works of the ground and of dampers on linear floors, by such weights.
void dp_stages_work(const struct dp *p, const double *weight, struct energy_account *energy);

// The n floors from `first` on, in whole lanes, that are looked at for peaks: negative are those
// that could have one in the step, and whose acceleration could.
enum { DP_LOOK = 8 * LANES_WIDTH };
struct dp_look {
    int first, n;
    int64_t hit[DP_LOOK], bends[DP_LOOK];
};

// What a step does with all floors, in vectors (dp_floors.h).
struct dp_floors {
    void (*take)(struct dp *p);                     // dp_stages_take, once length and end are set
    double (*error)(const struct dp *p);            // largest of u and v over their sizes
    bool (*look)(struct dp *p, struct dp_look *l);  // and drifts; true: any could
    void (*work)(const struct dp *p, const double *time, struct energy_account *energy);
};
extern const struct dp_floors dp_narrow, dp_wide;

#endif
