// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/study_box.h"

struct h5_block study_box(const struct sweep *const *sweep, int n, long first, long capacity) {
    hsize_t dim[STUDY_SWEEPS_MAX];
    for (int i = 0; i < n; i++) {
        dim[i] = (hsize_t)sweep[i]->n;
    }
    return h5_box(dim, n, (hsize_t)first, (hsize_t)capacity);
}
