// SPDX-License-Identifier: GPL-3.0-or-later
// What the loops over floors leave out of buildings with full matrices, all parts of which are
// linear: C v, and the shears of the parts. On the vectors of floor_vectors.h.
#ifndef JOSTLE_FLOORS_FULL_H
#define JOSTLE_FLOORS_FULL_H

#include <stdalign.h>

#include "solve/floors/floor_vectors.h"
#include "solve/work.h"

// Takes the shears of parts at displacements u off the residual.
LANES_INLINE void floors_full_parts(const struct effective *e, const double *u, double *residual) {
    alignas(LANES_LINE) double drift[INVERSE_FLOORS_MAX];
    alignas(LANES_LINE) double shear[INVERSE_FLOORS_MAX + LANES_WIDTH] = {0.0};
    floor_lanes under = {0.0};
    for (int i = 0; i < e->stride; i += FLOORS_VECTOR) {
        const floor_lanes own = FLOORS_AT(u, i);
        *(floor_lanes *)(drift + i) = own - BELOW(under, own);
        under = own;
    }
    floors_multiply(e->parts, e->building->n_floor, drift, shear);
    for (int i = 0; i < e->stride; i += FLOORS_VECTOR) {
        const floor_lanes own = FLOORS_AT(shear, i), over = FLOORS_AT(shear, i + FLOORS_VECTOR);
        *(floor_lanes *)(residual + i) = FLOORS_AT(residual, i) - own + ABOVE(own, over);
    }
}

// Takes the forces of a low building at its trial off its residual. What is read and written beyond
// it belongs to the next building, and is changed by 0.
LANES_INLINE void floors_full_low(const struct effective *e, const double *u, const double *v,
                                  double *residual) {
    alignas(LANES_LINE) double force[INVERSE_FLOORS_MAX] = {0.0};  // not all columns may be written
    floors_multiply(e->damping, e->building->n_floor, v, force);
    for (int i = 0; i < e->stride; i += FLOORS_VECTOR) {
        *(floor_lanes *)(residual + i) = FLOORS_AT(residual, i) - FLOORS_AT(force, i);
    }
    if (e->parts) {
        floors_full_parts(e, u, residual);
    }
}

// The same for the buildings of a block; u, v and the residual are from its first floor on.
LANES_INLINE void floors_full(const struct work *w, const struct floor_block *b, const double *u,
                              const double *v, double *residual) {
    const struct effective *e = &w->effective[b->building];
    for (int i = 0; i < b->n_building; i++, e++) {
        const ptrdiff_t at = e->building->first - b->first;
        if (e->damping && e->stride <= INVERSE_FLOORS_MAX) {
            floors_full_low(e, u + at, v + at, residual + at);
        } else if (e->damping) {
            floors_full_high(e, u + at, v + at, residual + at);
        }
    }
}

#endif
