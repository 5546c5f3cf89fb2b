// SPDX-License-Identifier: GPL-3.0-or-later
// How long the steps of Dormand & Prince's method are.
#ifndef JOSTLE_DP_CONTROL_H
#define JOSTLE_DP_CONTROL_H

#include "solve/dormand_prince/dp.h"

// The first step, before there is any error.
void dp_control_start(struct dp *p);

// The next instant at which a step has to end.
double dp_control_limit(const struct dp *p);

// Tries steps until one meets the tolerance. STATUS_FAILED: they become too short or too many;
// names the time and the cause.
int dp_control_attempt(struct dp *p, struct error *e);

// The estimated error of the step, over the tolerance.
double dp_control_error(const struct dp *p);

// Rejects the step for this error: the next one is shorter. STATUS_FAILED: it cannot be.
int dp_control_reject(struct dp *p, double error, struct error *e);

#endif
