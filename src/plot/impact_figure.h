// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of isolated impacts: force against time, and against penetration.
#ifndef JOSTLE_IMPACT_FIGURE_H
#define JOSTLE_IMPACT_FIGURE_H

#include "law/isolated.h"
#include "plot/figure.h"

enum { IMPACT_FIGURE_CURVES = 7 };

struct impact_curve {
    const char *name;
    size_t n;
    const struct isolated_point *point;  // (n) in SI
    double start;                        // time of the first one
};

struct impact_figure {
    const char *title, *subtitle, *version;
    const struct isolated_impact *impact;  // its numbers stand above the panels; NULL: none do
    double nominal;                        // coefficient of restitution asked of it; NAN: none
    int n_curve;                           // at most IMPACT_FIGURE_CURVES
    const struct impact_curve *curve;
    size_t n_sample;             // of a measured force; 0: there is none
    const double *time, *force;  // (n_sample)
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending),
// STATUS_SYSTEM (no memory). Write errors are the caller's.
int impact_figure_write(const struct impact_figure *f, const struct figure_files *to,
                        struct error *e);

#endif
