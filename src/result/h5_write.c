// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes and datasets with their units, long names and dimension scales. No object keeps the
// time of its making, so that the same run gives the same bytes.
#include <assert.h>
#include <hdf5_hl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "result/h5.h"

static void write_attribute(struct h5 *h, hid_t attribute, hid_t type, const void *value) {
    if (!h5_failed(h, attribute)) {
        h5_failed(h, H5Awrite(attribute, type, value));
        H5Aclose(attribute);
    }
}

// Of an object that does not have it yet.
static void add_attribute(struct h5 *h, hid_t object, const char *name, hid_t type,
                          const void *value) {
    if (!h->failed) {
        write_attribute(h, H5Acreate2(object, name, type, h->scalar, H5P_DEFAULT, H5P_DEFAULT),
                        type, value);
    }
}

void h5_put_text(struct h5 *h, hid_t object, const char *name, const char *text) {
    htri_t present = h->failed ? -1 : H5Aexists(object, name);
    if (present > 0) {
        write_attribute(h, H5Aopen(object, name, H5P_DEFAULT), h->text, &text);
    } else if (!h5_failed(h, present)) {
        add_attribute(h, object, name, h->text, &text);
    }
}

void h5_put_long(struct h5 *h, hid_t object, const char *name, long value) {
    add_attribute(h, object, name, H5T_NATIVE_LONG, &value);
}

void h5_put_double(struct h5 *h, hid_t object, const char *name, double value) {
    add_attribute(h, object, name, H5T_NATIVE_DOUBLE, &value);
}

// The creation list of datasets in chunks, kept for the next one, which is often alike.
static hid_t chunked_list(struct h5 *h, const struct h5_chunk *c) {
    const struct h5_chunk *last = &h->chunk;
    if (h->chunked > 0 && last->n_dim == c->n_dim && last->rows == c->rows &&
        last->width == c->width && last->compress == c->compress) {
        return h->chunked;
    }
    hid_t list = H5Pcopy(h->plain);
    if (h5_failed(h, list)) {
        return list;
    }
    const hsize_t size[2] = {c->rows, c->width};
    const double missing = NAN;  // rows not yet written read as this
    h5_failed(h, H5Pset_chunk(list, c->n_dim, size));
    h5_failed(h, H5Pset_fill_value(list, H5T_NATIVE_DOUBLE, &missing));
    if (c->compress > 0) {
        h5_failed(h, H5Pset_shuffle(list));
        h5_failed(h, H5Pset_deflate(list, (unsigned)c->compress));
    }
    if (h->chunked > 0) {
        H5Pclose(h->chunked);
    }
    h->chunk = *c;
    return h->chunked = list;
}

// The creation list of a dataset, by the number of its bytes (of a text: of the pointer to it). Few
// bytes go into the object header of the dataset, which is faster than a place of their own; the
// header takes 64 KiB at most.
static hid_t storage_list(struct h5 *h, const struct h5_dataset *d) {
    enum { FEW_BYTES = 512 };
    hsize_t bytes = H5Tget_size(d->file_type);
    for (int i = 0; i < d->n_dim; i++) {
        bytes *= d->dim[i];
    }
    if (d->chunk_rows > 0 && (bytes > 0 || d->may_be_cut)) {
        assert(d->n_dim <= 2);
        const hsize_t width = d->dim[1] > 0 ? d->dim[1] : 1;
        return chunked_list(h, &(struct h5_chunk){d->n_dim, d->chunk_rows, width, d->compress});
    }
    return bytes <= FEW_BYTES ? h->compact : h->plain;
}

static hid_t create(struct h5 *h, hid_t parent, const struct h5_dataset *d) {
    const hid_t usual = storage_list(h, d), access = usual == h->chunked ? h->access : H5P_DEFAULT;
    hid_t list = h->failed || !d->many_users ? usual : H5Pcopy(usual), dataset = -1;
    // A chunk may not be wider than its dataset ever is.
    const hsize_t most[2] = {d->dim[0], d->dim[1] > 0 ? d->dim[1] : H5S_UNLIMITED};
    hid_t space = H5Screate_simple(d->n_dim, d->dim, d->may_be_cut ? most : NULL);
    // A scale of thousands of datasets lists them in an attribute of more than the 64 KiB that an
    // object header takes, so it keeps its attributes outside.
    if (d->many_users && !h5_failed(h, list)) {
        h5_failed(h, H5Pset_attr_creation_order(list, H5P_CRT_ORDER_TRACKED));
        h5_failed(h, H5Pset_attr_phase_change(list, 0, 0));
    }
    if (!h5_failed(h, space)) {
        dataset = H5Dcreate2(parent, d->name, d->file_type, space, H5P_DEFAULT, list, access);
        h5_failed(h, dataset);
    }
    h5_drop(space);
    h5_drop(list != usual ? list : -1);
    return dataset;
}

hid_t h5_dataset(struct h5 *h, hid_t parent, const struct h5_dataset *d) {
    hid_t dataset = h5_has_room(h) ? create(h, parent, d) : -1;
    if (dataset < 0) {
        return dataset;
    }
    char units[64] = "1";
    if (d->quantity.dimension) {
        unit_text(h->units, *d->quantity.dimension, units, sizeof units);
    }
    const char *text = units;
    add_attribute(h, dataset, "units", h->text, &text);
    add_attribute(h, dataset, "long_name", h->text, &d->quantity.long_name);
    bool is_scale = d->n_dim == 1 && d->scale[0] <= 0;
    if (is_scale && !h->failed) {
        h5_failed(h, H5DSset_scale(dataset, d->name));
    } else {
        h5_attach(h, dataset, d->scale, d->n_dim);
    }
    if (h->failed) {
        H5Dclose(dataset);
        return -1;
    }
    return dataset;
}

void h5_cut(struct h5 *h, hid_t dataset, size_t rows) {
    const hid_t space = h->failed ? -1 : H5Dget_space(dataset);
    hsize_t size[2];
    if (h->failed || h5_failed(h, space)) {
        return;
    }
    const int n_dim = H5Sget_simple_extent_dims(space, size, NULL);
    size[0] = rows;
    H5Sclose(space);
    h5_failed(h, n_dim == 1 || n_dim == 2 ? H5Dset_extent(dataset, size) : -1);
}

void h5_put(struct h5 *h, hid_t parent, const struct h5_dataset *d, const void *data) {
    hid_t dataset = h5_dataset(h, parent, d);
    if (dataset < 0) {
        return;
    }
    if (d->dim[0] > 0) {
        h5_put_box(h, dataset, NULL, d->memory_type, data);
    }
    h5_close(h, dataset);
}

hid_t h5_put_scale(struct h5 *h, hid_t parent, const char *name, const char *long_name, size_t n) {
    int *number = malloc((n + 1) * sizeof *number);
    if (!number) {
        h5_no_memory(h);
        return -1;
    }
    for (size_t i = 0; i < n; i++) {
        number[i] = (int)i + 1;
    }
    const struct h5_dataset d = {
        .name = name,
        .quantity = {long_name, NULL},
        .memory_type = H5T_NATIVE_INT,
        .file_type = H5T_STD_I32LE,
        .n_dim = 1,
        .dim = {n},
    };
    hid_t scale = h5_dataset(h, parent, &d);
    if (scale >= 0 && n > 0) {
        h5_put_box(h, scale, NULL, H5T_NATIVE_INT, number);
    }
    free(number);
    return scale;
}

// Memory and file types of a kind of column.
static struct h5_dataset column_dataset(const struct h5 *h, const struct column *c) {
    struct h5_dataset d = {.name = c->name, .quantity = {c->long_name, c->dimension}};
    switch (c->kind) {
        case COLUMN_DOUBLE:
        case COLUMN_ARRAY:
            d.memory_type = H5T_NATIVE_DOUBLE;
            d.file_type = H5T_IEEE_F64LE;
            break;
        case COLUMN_LONG:
            d.memory_type = H5T_NATIVE_LONG;
            d.file_type = H5T_STD_I64LE;
            break;
        case COLUMN_INT:
        case COLUMN_FLAG:
            d.memory_type = H5T_NATIVE_LONG;
            d.file_type = H5T_STD_I32LE;
            break;
        case COLUMN_TEXT:
            d.memory_type = h->text;
            d.file_type = h->text;
            break;
    }
    return d;
}

// One value of a column on its way to the library.
union value {
    double number;
    long whole;
    char *text;
};
static_assert(sizeof(union value) == sizeof(double) && sizeof(long) == sizeof(double) &&
                  sizeof(char *) == sizeof(double),
              "an array of these is an array of any of their members");

void h5_put_column(struct h5 *h, hid_t parent, const struct column_table *t, int c,
                   const void *base, size_t n, hid_t scale) {
    const struct column *column = &t->column[c];
    union value *data = calloc(n + 1, sizeof *data);
    if (!data) {
        h5_no_memory(h);
        return;
    }
    struct h5_dataset d = column_dataset(h, column);
    for (size_t i = 0; i < n; i++) {
        const void *at = layout_at(t, c, base, i);
        if (d.memory_type == H5T_NATIVE_LONG) {
            data[i].whole = layout_whole(column, at);
        } else {
            memcpy(&data[i], at, sizeof data[i]);
        }
    }
    d.n_dim = 1;
    d.dim[0] = n;
    d.scale[0] = scale;
    h5_put(h, parent, &d, data);
    free(data);
}

void h5_put_member(struct h5 *h, hid_t object, const struct column_table *t, int c,
                   const void *base) {
    const struct h5_dataset d = column_dataset(h, &t->column[c]);
    add_attribute(h, object, t->column[c].name, d.memory_type, layout_at(t, c, base, 0));
}
