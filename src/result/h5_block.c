// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of datasets with several dimensions.
#include <stdlib.h>
#include <string.h>

#include "result/h5.h"

// Selects the box in the file and in memory; false after a failure. Both are to be closed.
static bool select_box(struct h5 *h, hid_t dataset, const struct h5_block *part, hid_t *file,
                       hid_t *memory) {
    const hsize_t size[2] = {part->n, part->stride}, start[2] = {0, 0};
    const hsize_t count[2] = {part->n, part->width};
    *file = H5Dget_space(dataset);
    *memory = H5Screate_simple(2, size, NULL);
    return !h5_failed(h, *file) && !h5_failed(h, *memory) &&
           !h5_failed(h, H5Sselect_hyperslab(*file, H5S_SELECT_SET, part->start, NULL, part->count,
                                             NULL)) &&
           !h5_failed(h, H5Sselect_hyperslab(*memory, H5S_SELECT_SET, start, NULL, count, NULL));
}

static void close_spaces(hid_t file, hid_t memory) {
    if (memory >= 0) {
        H5Sclose(memory);
    }
    if (file >= 0) {
        H5Sclose(file);
    }
}

static void put(struct h5 *h, hid_t dataset, const struct h5_block *part, hid_t type,
                const void *value) {
    hid_t file = -1, memory = -1;
    if (h5_has_room(h) && select_box(h, dataset, part, &file, &memory)) {
        h5_failed(h, H5Dwrite(dataset, type, memory, file, H5P_DEFAULT, value));
    }
    close_spaces(file, memory);
}

static void get(struct h5 *h, hid_t dataset, const struct h5_block *part, hid_t type, void *value) {
    hid_t file = -1, memory = -1;
    if (h5_has_room(h) && select_box(h, dataset, part, &file, &memory)) {
        h5_failed(h, H5Dread(dataset, type, memory, file, H5P_DEFAULT, value));
    }
    close_spaces(file, memory);
}

// The columns go side by side first: from rows with others between, the library writes each row of
// a dataset that is not in chunks by itself.
void h5_put_block(struct h5 *h, hid_t dataset, const struct h5_block *part, const double *value) {
    const size_t width = (size_t)part->width;
    double *row = h->failed ? NULL : malloc(((size_t)part->n * width + 1) * sizeof *row);
    if (!row) {
        h5_no_memory(h);
        return;
    }
    for (size_t i = 0; i < part->n; i++) {
        memcpy(row + i * width, value + i * part->stride, width * sizeof *row);
    }
    struct h5_block packed = *part;
    packed.stride = part->width;
    put(h, dataset, &packed, H5T_NATIVE_DOUBLE, row);
    free(row);
}

void h5_put_integers(struct h5 *h, hid_t dataset, const struct h5_block *part, const int *value) {
    put(h, dataset, part, H5T_NATIVE_INT, value);
}

void h5_put_texts(struct h5 *h, hid_t dataset, const struct h5_block *part,
                  const char *const *text) {
    put(h, dataset, part, h->text, text);
}

void h5_get_block(struct h5 *h, hid_t dataset, const struct h5_block *part, double *value) {
    get(h, dataset, part, H5T_NATIVE_DOUBLE, value);
}

void h5_get_integers(struct h5 *h, hid_t dataset, const struct h5_block *part, int *value) {
    get(h, dataset, part, H5T_NATIVE_INT, value);
}

void h5_get_references(struct h5 *h, hid_t dataset, const struct h5_block *part,
                       struct h5_reference *reference) {
    get(h, dataset, part, h->heap.reference, reference);
}

struct h5_block h5_box(const hsize_t *dim, int n_dim, hsize_t first, hsize_t most) {
    struct h5_block box = {.n = 1};
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

// In a space of the dataset's own rank: between two ranks the library goes value by value.
void h5_get_box(struct h5 *h, hid_t dataset, const struct h5_block *box, int n_dim, hid_t type,
                void *value) {
    hid_t file = H5S_ALL, memory = H5S_ALL;
    if (!h5_has_room(h)) {
        return;
    }
    if (box) {
        file = H5Dget_space(dataset);
        memory = H5Screate_simple(n_dim, box->count, NULL);
    }
    if (!box || (!h5_failed(h, file) && !h5_failed(h, memory) &&
                 !h5_failed(h, H5Sselect_hyperslab(file, H5S_SELECT_SET, box->start, NULL,
                                                   box->count, NULL)))) {
        h5_failed(h, H5Dread(dataset, type, memory, file, h->transfer, value));
    }
    if (box) {
        close_spaces(file, memory);
    }
}
