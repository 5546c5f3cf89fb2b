// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of datasets with several dimensions.
#include <stdlib.h>
#include <string.h>

#include "result/h5.h"

struct h5_box h5_box(const hsize_t *dim, int n_dim, hsize_t first, hsize_t most) {
    struct h5_box box = {.n = 1};
    hsize_t inner = 1, rest = first;  // values for each step in dimension i
    for (int i = n_dim - 1; i >= 0; i--) {
        const hsize_t at = rest % dim[i];
        hsize_t count = box.n == inner ? most / inner : 1;
        count = count < 1 ? 1 : count > dim[i] - at ? dim[i] - at : count;
        box.start[i] = at;
        box.count[i] = count;
        box.n *= count;
        inner *= dim[i];
        rest /= dim[i];
    }
    return box;
}

// Writes `from`, or reads into `to`. The space in memory has the dataset's own rank: between two
// ranks the library goes value by value.
static void move(struct h5 *h, hid_t dataset, const struct h5_box *box, hid_t type,
                 const void *from, void *to) {
    hid_t file = H5S_ALL, memory = H5S_ALL;
    if (!h5_has_room(h)) {
        return;
    }
    if (box) {
        file = H5Dget_space(dataset);
        memory = H5Screate_simple(H5Sget_simple_extent_ndims(file), box->count, NULL);
        if (!h5_failed(h, file) && !h5_failed(h, memory)) {
            h5_failed(
                h, H5Sselect_hyperslab(file, H5S_SELECT_SET, box->start, NULL, box->count, NULL));
        }
    }
    if (!h->failed) {
        h5_failed(h, from ? H5Dwrite(dataset, type, memory, file, h->transfer, from)
                          : H5Dread(dataset, type, memory, file, h->transfer, to));
    }
    h5_drop(memory);
    h5_drop(file);
}

void h5_put_box(struct h5 *h, hid_t dataset, const struct h5_box *box, hid_t type,
                const void *value) {
    move(h, dataset, box, type, value, NULL);
}

void h5_get_box(struct h5 *h, hid_t dataset, const struct h5_box *box, hid_t type, void *value) {
    move(h, dataset, box, type, NULL, value);
}

// Widens the box from values to rows of `width` values. Gives room for the rows side by side; NULL:
// no memory.
static double *widen(struct h5 *h, struct h5_box *box, int n_front, size_t width) {
    double *row = h->failed ? NULL : malloc((box->n * width + 1) * sizeof *row);
    if (!row) {
        h5_no_memory(h);
    }
    box->start[n_front] = 0;
    box->count[n_front] = width;
    return row;
}

// From rows with others between, the library would write each row of a dataset that is not in
// chunks by itself.
void h5_put_columns(struct h5 *h, hid_t dataset, struct h5_box box, int n_front, size_t width,
                    size_t stride, const double *value) {
    double *row = widen(h, &box, n_front, width);
    for (size_t i = 0; row && i < box.n; i++) {
        memcpy(row + i * width, value + i * stride, width * sizeof *row);
    }
    if (row) {
        h5_put_box(h, dataset, &box, H5T_NATIVE_DOUBLE, row);
    }
    free(row);
}

void h5_get_columns(struct h5 *h, hid_t dataset, struct h5_box box, int n_front, size_t width,
                    size_t stride, double *value) {
    double *row = widen(h, &box, n_front, width);
    if (row) {
        h5_get_box(h, dataset, &box, H5T_NATIVE_DOUBLE, row);
    }
    for (size_t i = 0; row && !h->failed && i < box.n; i++) {
        memcpy(value + i * stride, row + i * width, width * sizeof *row);
    }
    free(row);
}
