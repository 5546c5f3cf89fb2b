// SPDX-License-Identifier: GPL-3.0-or-later
// Units of axes in which values need few digits.
#ifndef JOSTLE_PLOT_SCALE_H
#define JOSTLE_PLOT_SCALE_H

#include "plot/canvas.h"

struct scale {
    double size;
    const char *unit;  // NULL behind the last of a list
};
extern const struct scale scale_forces[], scale_lengths[], scale_energies[];

// The unit of the list for values up to `largest`.
struct scale scale_for(const struct scale *known, double largest);

struct axis scale_axis(const char *name, const struct scale *s, struct span span);

#endif
