// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of one group of a suite, as the fits of a fragility take them.
#ifndef JOSTLE_FRAGILITY_RUNS_H
#define JOSTLE_FRAGILITY_RUNS_H

#include "study/fragility.h"
#include "study/suite.h"

// A bootstrap draws units: the samples, with all their intensities. Where the suite has no samples,
// such as stripes with records of their own, each run is a unit.
struct fragility_run {
    double intensity;
    double demand;  // INFINITY: above all values; NAN: left out
    int unit;
};
struct fragility_runs {
    int n;
    struct fragility_run *run;  // (n) by intensity, ascending
    int n_unit;
    bool each;  // each run is a unit, of its own number
};

// Room for the runs of a group, from the arena of `s`. Errors: STATUS_SYSTEM (no memory).
int fragility_runs_create(const struct suite *s, struct fragility_runs *out, struct error *e);

// The runs of a group.
void fragility_runs_take(struct fragility_runs *r, const struct suite *s, int group);

// Counts the runs over the limit at each intensity that occurs; values equal to the limit do not
// exceed it. A unit counts weight[unit] times; NULL: once. `level` has room for n levels; returns
// how many there are, ascending.
int fragility_runs_count(const struct fragility_runs *r, double limit, const int *weight,
                         struct fragility_level *level);

// The first exceedances of the units, (n_unit). The demand is taken as linear between two
// intensities; where it is above all values at the upper one, that is the crossing.
void fragility_runs_first(const struct fragility_runs *r, double limit,
                          struct fragility_record *record);

#endif
