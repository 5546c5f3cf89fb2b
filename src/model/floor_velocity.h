// SPDX-License-Identifier: GPL-3.0-or-later
// How fast floors are likely to move, estimated before an analysis.
#ifndef JOSTLE_FLOOR_VELOCITY_H
#define JOSTLE_FLOOR_VELOCITY_H

#include "jostle/model.h"

// The likely largest velocity of the floors of building `i`, relative to its ground, alone and
// elastic, and that of the drifts of its storeys. `velocity` and `drift_rate` are (n_floor) [L/T].
// Errors: STATUS_SYSTEM (no memory).
int floor_velocity(const struct model *m, int i, double *velocity, double *drift_rate,
                   struct error *e);

#endif
