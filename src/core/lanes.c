// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/lanes.h"

#include <stdint.h>

#include "core/arena.h"

// Bytes of a line of the cache, which no access of whole lanes should straddle.
enum { LINE = 64 };

double *lanes_array(struct arena *a, int n) {
    size_t line = LINE / sizeof(double);
    size_t room = (size_t)lanes_whole(n + 1) + 2 * (size_t)LANES_WIDTH + line;
    double *x = arena_alloc(a, room, sizeof *x);
    size_t beyond = (uintptr_t)x / sizeof *x % line;
    return x ? x + (line - beyond) % line + LANES_WIDTH : NULL;
}

void *lanes_wide_array(struct arena *a, int n, size_t size) {
    char *x = arena_alloc(a, (size_t)n + 3, size);
    if (!x) {
        return NULL;
    }
    uintptr_t over = (uintptr_t)x % sizeof(wide);
    return x + (sizeof(wide) - over) + size;
}
