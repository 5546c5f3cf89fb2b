// SPDX-License-Identifier: GPL-3.0-or-later
// A target spectrum: the pseudo-acceleration over the period that ground motions shall have, of a
// building code or of a hazard analysis.
#ifndef JOSTLE_MOTION_TARGET_H
#define JOSTLE_MOTION_TARGET_H

#include <stddef.h>

#include "jostle/error.h"

struct arena;

struct target {
    size_t n;              // at least 2
    const double *period;  // (n) [s] ascending, from >= 0
    const double *psa;     // (n) [m/s^2] > 0
};

// Reads rows of period and pseudo-acceleration, laid out as for records. The line above them gives
// the unit of the latter in brackets: `period [s], PSA [g]`; periods are in s if it gives none.
// What lasts is from `a`. Errors: STATUS_INPUT with "path:line:column: cause", STATUS_SYSTEM.
int target_read(struct arena *a, const char *path, struct target *out, struct error *e);

// The value at a period [m/s^2]: straight lines between the logarithms of both, and behind a point
// at T = 0, which has none, between the values themselves. NAN outside of the target.
double target_at(const struct target *t, double period);

#endif
