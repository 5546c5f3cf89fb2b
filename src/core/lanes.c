// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/lanes.h"

#include <assert.h>
#include <stdint.h>

#include "core/arena.h"

void *lanes_lines(struct arena *a, size_t n, size_t size) {
    assert(size > 0);
    char *x = arena_alloc(a, n + (LANES_LINE + size - 1) / size, size);
    size_t beyond = (uintptr_t)x % LANES_LINE;
    return x ? x + (LANES_LINE - beyond) % LANES_LINE : NULL;
}

double *lanes_array(struct arena *a, int n) {
    assert(n >= 0);
    size_t room = (size_t)lanes_whole(n + 1) + 2 * (size_t)LANES_WIDTH;
    double *x = lanes_lines(a, room, sizeof *x);
    return x ? x + LANES_WIDTH : NULL;
}

void *lanes_wide_array(struct arena *a, int n, size_t size) {
    assert(n >= 0 && size % sizeof(wide) == 0);
    char *x = arena_alloc(a, (size_t)n + 3, size);
    if (!x) {
        return NULL;
    }
    uintptr_t over = (uintptr_t)x % sizeof(wide);
    return x + (sizeof(wide) - over) + size;
}

bool lanes_hold_wide(void) {
    return LANES_WIDEST_OF(true, false);
}

bool lanes_hold_half(void) {
#if defined(__AVX2__)
    return true;
#elif defined(LANES_HALF)
    return __builtin_cpu_supports(LANES_HALF);
#else
    return false;
#endif
}

// Elements i to n - 1 of y, as long as there are `width` of them, which is what the type holds. The
// sums stay in registers.
#define SUM_COLUMNS(type, width, i, n, matrix, x, from, y)                                         \
    for (; i + (width) <= n; i += (width)) {                                                       \
        type sum = {0.0};                                                                          \
        if (from) {                                                                                \
            sum = *(const type *)(from + i);                                                       \
        }                                                                                          \
        for (int row = 0; row < n; row++) {                                                        \
            sum += *(const type *)(matrix + (ptrdiff_t)row * n + i) * x[row];                      \
        }                                                                                          \
        *(type *)(y + i) = sum;                                                                    \
    }

LANES void lanes_add_symmetric(int n, const double *matrix, const double *x, const double *from,
                               double *y) {
    int i = 0;
    SUM_COLUMNS(lanes_wide, LANES_WIDTH, i, n, matrix, x, from, y)
    SUM_COLUMNS(lanes, LANES_VECTOR, i, n, matrix, x, from, y)
    SUM_COLUMNS(double, 1, i, n, matrix, x, from, y)
}
