// SPDX-License-Identifier: GPL-3.0-or-later
// The motion within a step of Dormand & Prince's method, from what is known at both its ends.
#ifndef JOSTLE_DP_MOTION_H
#define JOSTLE_DP_MOTION_H

#include "solve/dormand_prince/dp.h"
#include "solve/dormand_prince/hermite.h"

// The motions of floor i, of link k, and of the drift of storey i.
struct motion dp_motion_floor(const struct dp *p, int i);
struct motion dp_motion_link(const struct dp *p, int k);
struct motion dp_motion_storey(const struct dp *p, int i);

// Ways of link k that mean nothing [L].
double dp_motion_noise(const struct dp *p, int k);

// Upper bounds of the penetrations of contacts, into p->reach, and what follows from them.
void dp_motion_reach(struct dp *p);

// The motion of all floors at place x of the step.
void dp_motion_between(const struct dp *p, double x, double *u, double *v);

// The total acceleration of floor i at place x of the step. Between steps only: it is made in the
// second stage.
double dp_motion_acceleration(struct dp *p, double x, int i);

#endif
