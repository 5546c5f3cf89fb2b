// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/study_box.h"

struct h5_block study_box(const struct sweep *const *sweep, int n, long first, long capacity) {
    struct h5_block box = {.n = 1};
    long inner = 1, rest = first;  // runs for each value of sweep i
    for (int i = n - 1; i >= 0; i--) {
        const long size = sweep[i]->n, at = rest % size;
        long count = box.n == (hsize_t)inner ? capacity / inner : 1;
        count = count < 1 ? 1 : count > size - at ? size - at : count;
        box.start[i] = (hsize_t)at;
        box.count[i] = (hsize_t)count;
        box.n *= (hsize_t)count;
        inner *= size;
        rest /= size;
    }
    return box;
}
