// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of an ensemble where a register holds all lanes.
#include "core/lanes.h"
#include "solve/ensemble/ensemble_contacts.h"

typedef wide part;
typedef wide_bits part_bits;
typedef lanes_wide unaligned;

#define CLONES LANES_WHOLE
#define STEPS ensemble_whole
#define SOLVE ensemble_contacts_solve
#define part_any ensemble_any

#if defined(__has_builtin) && __has_builtin(__builtin_shufflevector)
#define SHUFFLE(x, y, ...) __builtin_shufflevector(x, y, __VA_ARGS__)
#else
#define SHUFFLE(x, y, ...) __builtin_shuffle(x, y, (wide_bits){__VA_ARGS__})
#endif

LANES_INLINE void part_transpose(wide *x) {
    wide y[WIDE_RUNS];
    for (int i = 0; i < WIDE_RUNS; i += 2) {
        y[i] = SHUFFLE(x[i], x[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        y[i + 1] = SHUFFLE(x[i], x[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int i = 0; i < 2; i++) {
        const wide low = SHUFFLE(y[i], y[i + 2], 0, 1, 4, 5, 8, 9, 12, 13);
        const wide high = SHUFFLE(y[i], y[i + 2], 2, 3, 6, 7, 10, 11, 14, 15);
        const wide under = SHUFFLE(y[i + 4], y[i + 6], 0, 1, 4, 5, 8, 9, 12, 13);
        const wide over = SHUFFLE(y[i + 4], y[i + 6], 2, 3, 6, 7, 10, 11, 14, 15);
        x[i] = SHUFFLE(low, under, 0, 1, 4, 5, 8, 9, 12, 13);
        x[i + 4] = SHUFFLE(low, under, 2, 3, 6, 7, 10, 11, 14, 15);
        x[i + 2] = SHUFFLE(high, over, 0, 1, 4, 5, 8, 9, 12, 13);
        x[i + 6] = SHUFFLE(high, over, 2, 3, 6, 7, 10, 11, 14, 15);
    }
}

#include "solve/ensemble/ensemble_steps.h"
