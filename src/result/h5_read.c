// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what h5_write.c wrote, trusting nothing: names, kinds, shapes and sizes are checked before
// anything is allocated or converted.
#include <assert.h>
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "result/h5.h"

// How many bytes one stored byte can stand for. Deflate makes 1032 of one at most (zlib's technical
// details); of other filters, in a file that somebody has packed anew, nothing is known.
static hsize_t packing(hid_t dataset) {
    enum { DEFLATE = 1032 };
    hid_t list = H5Dget_create_plist(dataset);
    const int n = H5Pget_layout(list) == H5D_CHUNKED ? H5Pget_nfilters(list) : 0;
    hsize_t most = 1;
    for (int i = 0; i < n; i++) {
        unsigned flags, config;
        size_t values = 0;
        const H5Z_filter_t filter =
            H5Pget_filter2(list, (unsigned)i, &flags, &values, NULL, 0, NULL, &config);
        const bool keeps = filter == H5Z_FILTER_SHUFFLE || filter == H5Z_FILTER_FLETCHER32;
        most = keeps ? most : filter == H5Z_FILTER_DEFLATE && most == 1 ? DEFLATE : UINT64_MAX;
    }
    H5Pclose(list);
    return most;
}

// The library reads chunks whole.
static bool chunks_fit(hid_t dataset, size_t size) {
    enum { CHUNK_MAX = 64 << 20 };  // [bytes]
    hid_t list = H5Dget_create_plist(dataset);
    hsize_t dim[H5S_MAX_RANK], values = CHUNK_MAX / size;
    const int n = H5Pget_layout(list) == H5D_CHUNKED ? H5Pget_chunk(list, H5S_MAX_RANK, dim) : 0;
    for (int i = 0; i < n; i++) {
        values /= dim[i];
    }
    H5Pclose(list);
    return n == 0 || values > 0;
}

bool h5_is_stored(hid_t dataset) {
    hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    const size_t size = H5Tget_size(type);
    const hsize_t stored = H5Dget_storage_size(dataset);
    H5Tclose(type);
    H5Sclose(space);
    return n >= 0 && size > 0 && chunks_fit(dataset, size) &&
           ((hsize_t)n <= stored / size || (hsize_t)n / packing(dataset) <= stored / size);
}

bool h5_is_number(hid_t dataset) {
    hid_t type = H5Dget_type(dataset);
    const bool number = H5Tget_class(type) == H5T_FLOAT;
    H5Tclose(type);
    return number;
}

bool h5_has(struct h5 *h, hid_t parent, const char *name) {
    return h5_has_room(h) && H5Lexists(parent, name, H5P_DEFAULT) > 0;
}

hid_t h5_get_group(struct h5 *h, hid_t parent, const char *name) {
    if (h->failed) {
        return -1;
    }
    hid_t group = h5_has(h, parent, name) ? H5Gopen2(parent, name, H5P_DEFAULT) : -1;
    if (group < 0) {
        h5_fail(h, "group '%s' is missing", name);
    }
    return group;
}

// Reads the scalar attribute, whose type must be of `class`, as `type` into *value, which stays as
// it is after a failure.
static void get_attribute(struct h5 *h, hid_t object, const char *name, H5T_class_t class,
                          hid_t type, void *value) {
    if (!h5_has_room(h)) {
        return;
    }
    hid_t attribute = H5Aexists(object, name) > 0 ? H5Aopen(object, name, H5P_DEFAULT) : -1;
    if (attribute < 0) {
        h5_fail(h, "attribute '%s' is missing", name);
        return;
    }
    hid_t stored = H5Aget_type(attribute), space = H5Aget_space(attribute);
    if (stored < 0 || space < 0 || H5Tget_class(stored) != class ||
        H5Sget_simple_extent_npoints(space) != 1 ||
        (class == H5T_STRING && H5Tis_variable_str(stored) <= 0)) {
        h5_fail(h, "attribute '%s' is not of the kind expected", name);
    } else {
        h5_failed(h, H5Aread(attribute, type, value));
    }
    H5Tclose(stored);
    H5Sclose(space);
    H5Aclose(attribute);
}

void h5_get_reference(struct h5 *h, hid_t object, const char *name, struct h5_reference *out) {
    *out = (struct h5_reference){.byte = {0}};
    get_attribute(h, object, name, H5T_STRING, h->heap.reference, out);
}

char *h5_get_text(struct h5 *h, struct arena *a, hid_t object, const char *name) {
    struct h5_reference reference;
    h5_get_reference(h, object, name, &reference);
    return h->failed ? NULL : h5_heap_text(h, a, &reference);
}

char *h5_get_line(struct h5 *h, struct arena *a, hid_t object, const char *name) {
    char *text = h5_get_text(h, a, object, name);
    if (text && text_not_plain(text)) {
        h5_fail(h, "attribute '%s' has a control character or is not UTF-8", name);
    }
    return h->failed ? NULL : text;
}

long h5_get_long(struct h5 *h, hid_t object, const char *name) {
    long value = 0;
    get_attribute(h, object, name, H5T_INTEGER, H5T_NATIVE_LONG, &value);
    return value;
}

double h5_get_double(struct h5 *h, hid_t object, const char *name) {
    double value = 0;
    get_attribute(h, object, name, H5T_FLOAT, H5T_NATIVE_DOUBLE, &value);
    return value;
}

void h5_get_units(struct h5 *h, struct arena *a, struct unit_system *u) {
    const struct {
        const char *attribute;
        char *to;
    } name[] = {{"unit_force", u->force_name},
                {"unit_length", u->length_name},
                {"unit_time", u->time_name}};
    for (int i = 0; i < 3; i++) {
        const char *text = h5_get_line(h, a, h->file, name[i].attribute);
        if (text && strlen(text) >= UNIT_NAME_MAX) {
            h5_fail(h, "attribute '%s' is longer than %d characters", name[i].attribute,
                    UNIT_NAME_MAX - 1);
        } else if (text) {
            memcpy(name[i].to, text, strlen(text) + 1);
        }
    }
    u->force = h5_get_double(h, h->file, "unit_force_in_N");
    u->length = h5_get_double(h, h->file, "unit_length_in_m");
    u->time = h5_get_double(h, h->file, "unit_time_in_s");
    u->gravity = h5_get_double(h, h->file, "gravity_in_m_per_s2");
}

// Opens a list and gives its length.
static hid_t open_list(struct h5 *h, hid_t parent, const char *name, hsize_t *n) {
    if (h->failed) {
        return -1;
    }
    hid_t dataset = h5_has(h, parent, name) ? H5Dopen2(parent, name, H5P_DEFAULT) : -1;
    if (dataset < 0) {
        h5_fail(h, "dataset '%s' is missing", name);
        return -1;
    }
    hsize_t dim[H5S_MAX_RANK];
    hid_t space = H5Dget_space(dataset);
    const int n_dim = H5Sget_simple_extent_dims(space, dim, NULL);
    const bool good = n_dim == 1 || (h->n_front > 0 && n_dim == h->n_front + 1);
    *n = good ? dim[n_dim - 1] : 0;
    H5Sclose(space);
    if (!good || !h5_is_stored(dataset)) {
        h5_fail(h, "dataset '%s' %s", name,
                good ? "is not all there, or has chunks of more than 64 MiB"
                     : "has not one dimension");
        H5Dclose(dataset);
        return -1;
    }
    return dataset;
}

size_t h5_get_length(struct h5 *h, hid_t parent, const char *name, size_t limit) {
    hsize_t n = 0;
    hid_t dataset = open_list(h, parent, name, &n);
    if (dataset >= 0) {
        H5Dclose(dataset);
        if (n > limit) {
            h5_fail(h, "dataset '%s' has %llu values; at most %zu are allowed", name,
                    (unsigned long long)n, limit);
        }
    }
    return h->failed ? 0 : (size_t)n;
}

// Reads the `n` values of an open list into memory.
static void read_values(struct h5 *h, hid_t dataset, hid_t memory_type, hsize_t n, void *to) {
    struct h5_box box = {.n = n};
    hid_t space = H5Dget_space(dataset);
    const int n_front = H5Sget_simple_extent_ndims(space) - 1;
    H5Sclose(space);
    for (int i = 0; i < n_front; i++) {
        box.start[i] = h->front[i];
        box.count[i] = 1;
    }
    box.count[n_front < 0 ? 0 : n_front] = n;
    h5_get_box(h, dataset, &box, memory_type, to);
}

static bool is_number(H5T_class_t class) {
    return class == H5T_FLOAT || class == H5T_INTEGER;
}

// Reads `n` values as `memory_type`; the list must have just as many, of that class, or texts for
// references. With dimensions in front, all numbers are stored as floating-point ones.
static void read_list(struct h5 *h, hid_t parent, const char *name, hid_t memory_type, size_t n,
                      void *to) {
    hsize_t length = 0;
    hid_t dataset = open_list(h, parent, name, &length);
    if (dataset < 0) {
        return;
    }
    const H5T_class_t class =
        memory_type == h->heap.reference ? H5T_STRING : H5Tget_class(memory_type);
    hid_t type = H5Dget_type(dataset);
    if (length != n) {
        h5_fail(h, "dataset '%s' has %llu values, not %zu", name, (unsigned long long)length, n);
    } else if (type < 0 ||
               (H5Tget_class(type) != class &&
                !(h->n_front > 0 && is_number(class) && is_number(H5Tget_class(type)))) ||
               (class == H5T_STRING && H5Tis_variable_str(type) <= 0)) {
        h5_fail(h, "dataset '%s' is not of the kind expected", name);
    } else if (n > 0) {
        read_values(h, dataset, memory_type, n, to);
    }
    h5_drop(type);
    H5Dclose(dataset);
}

double *h5_get_doubles(struct h5 *h, struct arena *a, hid_t parent, const char *name, size_t n) {
    double *value = h5_alloc(h, a, n, sizeof *value);
    if (value) {
        read_list(h, parent, name, H5T_NATIVE_DOUBLE, n, value);
    }
    return value;
}

char **h5_get_texts(struct h5 *h, struct arena *a, hid_t parent, const char *name, size_t n) {
    char **text = h5_alloc(h, a, n, sizeof *text);
    struct h5_reference *reference = text ? calloc(n + 1, sizeof *reference) : NULL;
    if (reference && text) {
        read_list(h, parent, name, h->heap.reference, n, reference);
    } else {
        h5_no_memory(h);
    }
    for (size_t i = 0; text && i < n && !h->failed; i++) {
        text[i] = h5_heap_text(h, a, &reference[i]);
    }
    free(reference);
    return h->failed ? NULL : text;
}

// Where value `i` of a column goes.
static void *place(const struct column_table *t, int c, void *base, size_t i) {
    return (char *)base + i * t->size + t->column[c].offset;
}

// Whole numbers of kind COLUMN_FLAG and COLUMN_INT.
static void scatter_whole(struct h5 *h, const struct column_table *t, int c, void *base, size_t n,
                          const long *value) {
    const struct column *column = &t->column[c];
    const long most = column->kind == COLUMN_FLAG ? 1 : INT_MAX;
    for (size_t i = 0; i < n; i++) {
        const bool sound = value[i] >= 0 && value[i] <= most;
        if (!sound && !h->ended_early) {
            h5_fail(h, "dataset '%s' has the value %ld", column->name, value[i]);
            return;
        }
        void *to = place(t, c, base, i);
        if (column->kind == COLUMN_FLAG) {
            *(bool *)to = sound && value[i] != 0;
        } else {
            *(int *)to = sound ? (int)value[i] - column->base : 0;
        }
    }
}

void h5_get_column(struct h5 *h, struct arena *a, hid_t parent, const struct column_table *t, int c,
                   void *base, size_t n) {
    const enum column_kind kind = t->column[c].kind;
    const char *name = t->column[c].name;
    if (kind == COLUMN_ARRAY) {
        *(const double **)place(t, c, base, 0) = h5_get_doubles(h, a, parent, name, n);
        return;
    }
    if (kind == COLUMN_TEXT) {
        char **text = h5_get_texts(h, a, parent, name, n);
        for (size_t i = 0; text && i < n; i++) {
            *(const char **)place(t, c, base, i) = text[i];
        }
        return;
    }
    union {
        double number;
        long whole;
    } *data = calloc(n + 1, sizeof *data);
    static_assert(sizeof *data == sizeof(long), "as written");
    if (!data) {
        h5_no_memory(h);
        return;
    }
    read_list(h, parent, name, kind == COLUMN_DOUBLE ? H5T_NATIVE_DOUBLE : H5T_NATIVE_LONG, n,
              data);
    if (!h->failed && (kind == COLUMN_INT || kind == COLUMN_FLAG)) {
        scatter_whole(h, t, c, base, n, &data->whole);
    } else if (!h->failed) {
        for (size_t i = 0; i < n; i++) {
            memcpy(place(t, c, base, i), &data[i], sizeof *data);
        }
    }
    free(data);
}

void h5_get_member(struct h5 *h, struct arena *a, hid_t object, const struct column_table *t, int c,
                   void *base) {
    const char *name = t->column[c].name;
    void *to = place(t, c, base, 0);
    switch (t->column[c].kind) {
        case COLUMN_TEXT:
            *(const char **)to = h5_get_text(h, a, object, name);
            break;
        case COLUMN_DOUBLE:
            *(double *)to = h5_get_double(h, object, name);
            break;
        default:
            *(long *)to = h5_get_long(h, object, name);
    }
}
