// SPDX-License-Identifier: GPL-3.0-or-later
// Dimension scales, as the "HDF5 Dimension Scale Specification and Design Notes" of The HDF Group
// lays them out: a dataset names the scales of its dimensions in its attribute DIMENSION_LIST, and
// a scale the datasets that use it, and in which dimension, in REFERENCE_LIST.
//
// The library's own H5DSattach_scale writes REFERENCE_LIST again for each dataset. With HDF5 1.10.8
// the run of a row of 500 buildings takes 1.5 times as long by it; a row of 2000 buildings, and a
// study of 20 runs of 500 buildings, twice as long. So all uses are kept here and each list is
// written once. A study of 10,000 runs of two buildings has few datasets and takes as long either
// way.
#include <stdlib.h>
#include <string.h>

#include "result/h5.h"

// One dimension of one dataset that has a scale.
struct h5_use {
    hobj_ref_t scale;
    hobj_ref_t dataset;
    int dimension;
};

// An entry of REFERENCE_LIST.
struct entry {
    hobj_ref_t dataset;
    int dimension;
};

static struct h5_use *new_use(struct h5 *h) {
    if (h->n_use == h->use_capacity) {
        size_t capacity = 2 * h->use_capacity + 64;
        struct h5_use *use = realloc(h->use, capacity * sizeof *use);
        if (!use) {
            h5_no_memory(h);
            return NULL;
        }
        h->use = use;
        h->use_capacity = capacity;
    }
    return &h->use[h->n_use++];
}

static hobj_ref_t reference(struct h5 *h, hid_t object) {
    hobj_ref_t r = 0;
    if (!h->failed) {
        h5_failed(h, H5Rcreate(&r, object, ".", H5R_OBJECT, -1));
    }
    return r;
}

// Creates and writes an attribute (n).
static void put_list(struct h5 *h, hid_t object, const char *name, hid_t type, hsize_t n,
                     const void *value) {
    hid_t space = H5Screate_simple(1, &n, NULL);
    hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (!h5_failed(h, attribute)) {
        h5_failed(h, H5Awrite(attribute, type, value));
        H5Aclose(attribute);
    }
    H5Sclose(space);
}

void h5_attach(struct h5 *h, hid_t dataset, const hid_t *scale, int n_dim) {
    hobj_ref_t named[H5_DIMENSIONS_MAX];
    hvl_t list[H5_DIMENSIONS_MAX];
    hobj_ref_t self = reference(h, dataset);
    for (int i = 0; i < n_dim && !h->failed; i++) {
        list[i] = (hvl_t){0, NULL};
        if (scale[i] > 0) {
            named[i] = reference(h, scale[i]);
            list[i] = (hvl_t){1, &named[i]};
            struct h5_use *use = new_use(h);
            if (use) {
                *use = (struct h5_use){named[i], self, i};
            }
        }
    }
    if (h->failed) {
        return;
    }
    put_list(h, dataset, "DIMENSION_LIST", h->references, (hsize_t)n_dim, list);
}

bool h5_is_scale(hid_t dataset) {
    return H5Aexists(dataset, "CLASS") > 0;
}

// The references to lists of scales, one for each dimension.
static bool get_lists(struct h5 *h, hid_t dataset, int n_dim, struct h5_reference *list) {
    hid_t attribute = H5Aexists(dataset, "DIMENSION_LIST") > 0
                          ? H5Aopen(dataset, "DIMENSION_LIST", H5P_DEFAULT)
                          : -1;
    if (attribute < 0) {
        return false;
    }
    hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    hid_t item = H5Tget_class(type) == H5T_VLEN ? H5Tget_super(type) : -1;
    const bool good = item >= 0 && H5Tequal(item, H5T_STD_REF_OBJ) > 0 &&
                      H5Sget_simple_extent_npoints(space) == n_dim &&
                      !h5_failed(h, H5Aread(attribute, h->heap.reference, list));
    h5_drop(item);
    H5Tclose(type);
    H5Sclose(space);
    H5Aclose(attribute);
    return good;
}

hid_t h5_get_scale(struct h5 *h, hid_t dataset, int n_dim, int dimension) {
    struct h5_reference list[H5_DIMENSIONS_MAX];
    hobj_ref_t scale;
    size_t n = 0;
    if (h->failed || n_dim > H5_DIMENSIONS_MAX) {
        return -1;
    }
    const void *found = get_lists(h, dataset, n_dim, list)
                            ? h5_heap_get(h, &list[dimension], sizeof scale, &n)
                            : NULL;
    if (n < 1) {
        h5_fail(h, "dimension %d has no scale", dimension + 1);
        return -1;
    }
    memcpy(&scale, found, sizeof scale);
    hid_t object = H5Rdereference2(h->file, H5P_DEFAULT, H5R_OBJECT, &scale);
    if (!h5_failed(h, object) && H5Iget_type(object) != H5I_DATASET) {
        h5_fail(h, "the scale of dimension %d is not a dataset", dimension + 1);
    }
    return object;
}

static int compare(const void *a, const void *b) {
    const struct h5_use *x = a;
    const struct h5_use *y = b;
    if (x->scale != y->scale) {
        return x->scale < y->scale ? -1 : 1;
    }
    if (x->dataset != y->dataset) {
        return x->dataset < y->dataset ? -1 : 1;
    }
    return x->dimension - y->dimension;
}

// The first `n` uses are of one scale.
static void list_uses_of(struct h5 *h, hid_t type, const struct h5_use *use, size_t n) {
    struct entry *entry = calloc(n, sizeof *entry);
    hid_t scale = entry ? H5Rdereference2(h->file, H5P_DEFAULT, H5R_OBJECT, &use->scale) : -1;
    if (!entry) {
        h5_no_memory(h);
    } else if (!h5_failed(h, scale)) {
        for (size_t i = 0; i < n; i++) {
            entry[i] = (struct entry){use[i].dataset, use[i].dimension};
        }
        put_list(h, scale, "REFERENCE_LIST", type, n, entry);
    }
    h5_close(h, scale);
    free(entry);
}

void h5_list_uses(struct h5 *h) {
    if (h->failed || h->n_use == 0) {
        return;
    }
    hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(struct entry));
    if (!h5_failed(h, type)) {
        h5_failed(h, H5Tinsert(type, "dataset", HOFFSET(struct entry, dataset), H5T_STD_REF_OBJ));
        h5_failed(h,
                  H5Tinsert(type, "dimension", HOFFSET(struct entry, dimension), H5T_NATIVE_INT));
    }
    qsort(h->use, h->n_use, sizeof *h->use, compare);
    for (size_t first = 0; first < h->n_use && !h->failed;) {
        size_t n = 1;
        while (first + n < h->n_use && h->use[first + n].scale == h->use[first].scale) {
            n++;
        }
        list_uses_of(h, type, h->use + first, n);
        first += n;
    }
    h->n_use = 0;
    h5_drop(type);
}
