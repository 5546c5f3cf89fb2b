// SPDX-License-Identifier: GPL-3.0-or-later
// The floors of a step in vectors of four, for all processors.
#include "core/lanes.h"

typedef lanes dp_lanes;
typedef lanes_bits dp_bits;
#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define DP_BELOW(under, own) __builtin_shufflevector(under, own, 3, 4, 5, 6)
#define DP_ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4)
#else
#define DP_BELOW(under, own) ((lanes){(under)[3], (own)[0], (own)[1], (own)[2]})
#define DP_ABOVE(own, over) ((lanes){(own)[1], (own)[2], (own)[3], (over)[0]})
#endif
#define DP_CLONES LANES
#define DP_FLOORS dp_narrow

#include "solve/dp_floors.h"
