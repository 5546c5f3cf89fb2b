// SPDX-License-Identifier: GPL-3.0-or-later
// The hazard of a site: how often in a year an intensity is exceeded, and how often a limit is.
#ifndef JOSTLE_HAZARD_H
#define JOSTLE_HAZARD_H

#include <stddef.h>

#include "jostle/error.h"
#include "jostle/row.h"
#include "study/fragility.h"

struct arena;

// Between two points ln rate is linear in ln intensity.
struct hazard {
    size_t n;                 // at least 2
    const double *intensity;  // (n) ascending, > 0
    const double *rate;       // (n) exceedances in a year, descending, > 0
};

// Reads rows of intensity and mean annual rate of exceedance, laid out as for records. The line
// above the rows may give the unit of the intensity in brackets: `PGA [g], rate`. The intensities
// become numbers of `unit`, the size in SI of the study's unit. Memory is from `a`. Errors:
// STATUS_INPUT with "path:line:column: cause", STATUS_SYSTEM.
int hazard_read(struct arena *a, const char *path, struct dimension dimension, double unit,
                struct hazard *out, struct error *e);

// How often in a year a limit with the fragility `f` is exceeded at intensities up to `to`,
//     lambda = integral of P(x) |d rate(x)|
// (Cornell & Krawinkler 2000, PEER Center News 3(2)); NAN if no curve is fitted. From the first
// point of the curve on: what is below is left out. Where `to` is INFINITY, intensities above the
// last point count with the probability there.
double hazard_exceedances(const struct hazard *h, const struct fragility *f, double to);

// The most that the exceedances can be above hazard_exceedances(h, f, INFINITY), if beyond the last
// point all exceed the limit.
double hazard_beyond(const struct hazard *h, const struct fragility *f);

#endif
