// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a pounding force spectrum: the largest contact force as a colour over the periods
// of the left and the right structure.
#ifndef JOSTLE_POUNDING_MAP_H
#define JOSTLE_POUNDING_MAP_H

#include "plot/figure.h"

struct pounding_map {
    const char *title, *subtitle, *version;
    const struct unit_system *units;  // of the force
    int n;                            // periods of each structure, at least 3
    const double *period;             // (n) [s] > 0, ascending
    const double *force;              // (n, n) the left structure's period first
};

// Writes the script and its data. Errors: STATUS_INPUT (the picture has another ending). Write
// errors are the caller's.
int pounding_map_write(const struct pounding_map *map, const struct figure_files *to,
                       struct error *e);

#endif
