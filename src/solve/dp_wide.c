// SPDX-License-Identifier: GPL-3.0-or-later
// The floors of a step in vectors of eight, for processors with such registers.
#include "core/lanes.h"

#ifdef LANES_WIDEST

typedef lanes_wide dp_lanes;
typedef lanes_wide_bits dp_bits;
#define DP_BELOW(under, own) __builtin_shufflevector(under, own, 7, 8, 9, 10, 11, 12, 13, 14)
#define DP_ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4, 5, 6, 7, 8)
#define DP_CLONES __attribute__((target("arch=" LANES_WIDEST)))
#define DP_FLOORS dp_wide

#include "solve/dp_floors.h"

#endif
