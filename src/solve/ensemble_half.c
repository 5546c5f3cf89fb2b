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

#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define SHUFFLE(x, y, ...) __builtin_shufflevector(x, y, __VA_ARGS__)
#else
#define SHUFFLE(x, y, ...) __builtin_shuffle(x, y, (lanes_bits){__VA_ARGS__})
#endif

LANES_INLINE bool part_any(const long long *aboard, const lanes_bits *flags) {
    lanes_bits in;
    memcpy(&in, aboard, sizeof in);
    const lanes_bits set = *flags & in;
    return (set[0] | set[1] | set[2] | set[3]) < 0;
}

LANES_INLINE void part_transpose(lanes *x) {
    const lanes even = SHUFFLE(x[0], x[1], 0, 4, 2, 6), odd = SHUFFLE(x[0], x[1], 1, 5, 3, 7);
    const lanes far = SHUFFLE(x[2], x[3], 0, 4, 2, 6), out = SHUFFLE(x[2], x[3], 1, 5, 3, 7);
    x[0] = SHUFFLE(even, far, 0, 1, 4, 5);
    x[1] = SHUFFLE(odd, out, 0, 1, 4, 5);
    x[2] = SHUFFLE(even, far, 2, 3, 6, 7);
    x[3] = SHUFFLE(odd, out, 2, 3, 6, 7);
}

#include "solve/ensemble_steps.h"
