// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in vectors of four, for all processors.
#include "solve/floor_loops.h"

typedef lanes few_lanes;
typedef lanes_bits few_bits;
#define FEW_BELOW(under, own) BELOW(under, own)
#define FEW_ABOVE(own, over) ABOVE(own, over)

LANES_INLINE bool few_any(const few_bits *sign) {
    return floors_any(sign) < 0;
}

#define FEW_CLONES LANES
#define FEW_STEPS few_narrow

#include "solve/few_steps.h"
