// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of an ensemble where a register holds half of the lanes.
#include <string.h>

#include "core/lanes.h"

typedef lanes part;
typedef lanes_bits part_bits;
typedef lanes unaligned;

#define CLONES LANES
#define STEPS ensemble_half
#define SOLVE NULL
#define part_transpose lanes_transpose

LANES_INLINE bool part_any(const long long *active, const lanes_bits *flags) {
    lanes_bits in;
    memcpy(&in, active, sizeof in);
    const lanes_bits set = *flags & in;
    return (set[0] | set[1] | set[2] | set[3]) < 0;
}

#include "solve/ensemble/ensemble_steps.h"
