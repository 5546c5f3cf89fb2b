// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of few floors in vectors of eight, for processors with such registers: elsewhere what is
// carried from one step to the next would be in memory, and neighbours be taken one by one.
#include <string.h>

#include "solve/floor_loops.h"

#ifdef LANES_WIDEST

typedef lanes_wide few_lanes;
typedef lanes_wide_bits few_bits;
#define FEW_BELOW(under, own) __builtin_shufflevector(under, own, 7, 8, 9, 10, 11, 12, 13, 14)
#define FEW_ABOVE(own, over) __builtin_shufflevector(own, over, 1, 2, 3, 4, 5, 6, 7, 8)

LANES_INLINE bool few_any(const few_bits *sign) {
    const wide_bytes negative = __builtin_convertvector(*sign >> 63, wide_bytes);
    int64_t all;
    memcpy(&all, &negative, sizeof all);
    return all != 0;
}

#define FEW_CLONES __attribute__((target("arch=" LANES_WIDEST)))
#define FEW_STEPS few_wide

#include "solve/few_steps.h"

#endif
