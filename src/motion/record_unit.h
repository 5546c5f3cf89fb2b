// SPDX-License-Identifier: GPL-3.0-or-later
// Units as record files and users write them.
#ifndef JOSTLE_MOTION_RECORD_UNIT_H
#define JOSTLE_MOTION_RECORD_UNIT_H

#include "jostle/units.h"
#include "motion/lines.h"

// Reads the whole of `text` as a unit: a unit of unit_parse, or also G, CM/S/S, cm/sec/sec,
// cm/sec**2. False: it is not a unit.
bool record_unit(struct piece text, double gravity, struct dimension *dimension, double *si);

#endif
