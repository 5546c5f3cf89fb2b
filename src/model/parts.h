// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a building's resistance beside its shear storeys, all together (jostle/part.h).
#ifndef JOSTLE_PARTS_H
#define JOSTLE_PARTS_H

#include "jostle/model.h"

// Adds what all parts of building `g` give at these drifts and drift rates (n_floor). `history` is
// the storey history of a state, `after` that of the next one or NULL: see struct part_kind. Rates
// are not read where the building is elastic.
void parts_respond(const struct building *g, const double *history, const double *drift,
                   const double *rate, const struct part_sums *to, double *after);

// Recoverable energy of the parts of building `g` [F L].
double parts_stored(const struct building *g, const double *history, const double *drift);

// Entry (i, j) of a matrix on drifts (n, n) as one on floor displacements.
static inline double parts_on_floors(const double *on_drifts, int n, int i, int j) {
    const double *x = on_drifts + (size_t)i * (size_t)n + (size_t)j;
    const bool above = i + 1 < n, beside = j + 1 < n;
    return x[0] - (above ? x[n] : 0.0) - (beside ? x[1] : 0.0) + (above && beside ? x[n + 1] : 0.0);
}

#endif
