// SPDX-License-Identifier: GPL-3.0-or-later
// The scales of errors in adaptive steps: the largest displacement and velocity of any floor of the
// building so far.
#ifndef JOSTLE_SCALE_H
#define JOSTLE_SCALE_H

#include <float.h>

#include "jostle/analysis.h"
#include "solve/fields.h"

// Of a length: what means nothing.
static const double SCALE_ROUNDING = 64.0 * DBL_EPSILON;

struct scales {
    double *over_u, *over_v;  // [1/L] [T/L] (n_dof) 1 over the sizes; 0: nothing moves
    double most_u, most_v;    // [L] [L/T] of any building so far
    double most_a;            // [L/T^2] of accelerations
    int noisy;  // a building whose displacements are rounded by more than its accelerations allow;
                // -1
    double *square, *memory;  // [1/T^2] [T] (n_building) NULL: accelerations do not matter
};
extern const struct fields scale_fields;  // but for `square` and `memory`, which stay

// Starts with sizes that motions will at least reach: those of the slowest mode under a hundredth
// of the excitation. Without them a start from rest, under forces that have a kink there, would
// take steps without end.
void scale_expect(struct scales *s, const struct model *m);

// Updates the scales from the peaks so far.
void scale_update(struct scales *s, const struct model *m, const struct results *r);

#endif
