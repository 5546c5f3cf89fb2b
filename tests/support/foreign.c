// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/foreign.h"

#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/support.h"

struct visit {
    struct foreign_field *field;
    int n;
    const char *object;
};

static void add(struct visit *v, const char *path, const char *mark, const char *name) {
    static const char *const fixed[] = {"format",    "status", "unit_force", "unit_length",
                                        "unit_time", "units",  "file_sum",   "study"};
    assert_in_range(v->n, 0, FOREIGN_FIELDS_MAX - 1);
    struct foreign_field *f = &v->field[v->n++];
    const char *last = strrchr(name, '/') ? strrchr(name, '/') + 1 : name;
    snprintf(f->path, sizeof f->path, "%s%s%s", path, mark, name);
    f->fixed = 0;
    for (size_t i = 0; i < sizeof fixed / sizeof fixed[0]; i++) {
        f->fixed |= strcmp(last, fixed[i]) == 0;
    }
}

static int is_text(hid_t type) {
    return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) > 0;
}

static herr_t visit_attribute(hid_t object, const char *name, const H5A_info_t *info,
                              void *context) {
    struct visit *v = context;
    (void)info;
    hid_t a = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(a);
    if (is_text(type)) {
        add(v, v->object, "@", name);
    }
    H5Tclose(type);
    H5Aclose(a);
    return 0;
}

static herr_t visit_object(hid_t file, const char *name, const H5O_info_t *info, void *context) {
    struct visit *v = context;
    char path[256];
    snprintf(path, sizeof path, "/%s", strcmp(name, ".") == 0 ? "" : name);
    v->object = path;
    hid_t o = H5Oopen(file, path, H5P_DEFAULT);
    H5Aiterate2(o, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_attribute, v);
    if (info->type == H5O_TYPE_DATASET) {
        hid_t type = H5Dget_type(o);
        if (is_text(type)) {
            add(v, "", "", path);
        }
        H5Tclose(type);
    }
    H5Oclose(o);
    return 0;
}

static herr_t visit_link(hid_t group, const char *name, const H5L_info_t *info, void *context) {
    struct visit *v = context;
    (void)group, (void)info;
    add(v, "=", v->object, name);
    return 0;
}

static void add_names(hid_t file, struct visit *v) {
    static const char *const groups[] = {"/buildings/", "/sweep/"};
    for (int i = 0; i < 2; i++) {
        v->object = groups[i];
        if (H5Lexists(file, groups[i], H5P_DEFAULT) > 0) {
            hid_t group = H5Gopen2(file, groups[i], H5P_DEFAULT);
            H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, NULL, visit_link, v);
            H5Gclose(group);
        }
    }
}

int foreign_fields(const char *file, struct foreign_field *field) {
    struct visit v = {.field = field};
    hid_t f = H5Fopen(file, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(f >= 0);
    assert_true(H5Ovisit(f, H5_INDEX_NAME, H5_ITER_INC, visit_object, &v) >= 0);
    add_names(f, &v);
    H5Fclose(f);
    return v.n;
}

static hid_t open_copy(const char *from, const char *to) {
    size_t n;
    const char *bytes = support_read(from, &n);
    FILE *out = fopen(to, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, n, out), n);
    fclose(out);
    hid_t file = H5Fopen(to, H5F_ACC_RDWR, H5P_DEFAULT);
    assert_true(file >= 0);
    return file;
}

static void write_texts(hid_t file, const char *path, const char *text) {
    hid_t d = H5Dopen2(file, path, H5P_DEFAULT), type = H5Dget_type(d), space = H5Dget_space(d);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    const char **list = malloc((size_t)(n + 1) * sizeof *list);
    for (hssize_t i = 0; i < n; i++) {
        list[i] = text;
    }
    assert_true(H5Dwrite(d, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, list) >= 0);
    free(list);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(d);
}

static void write_attribute(hid_t file, const char *path, const char *text) {
    char object[256];
    const char *mark = strrchr(path, '@');
    snprintf(object, sizeof object, "%.*s", (int)(mark - path), path);
    hid_t o = H5Oopen(file, object, H5P_DEFAULT), a = H5Aopen(o, mark + 1, H5P_DEFAULT);
    hid_t type = H5Aget_type(a);
    assert_true(H5Awrite(a, type, &text) >= 0);
    H5Tclose(type);
    H5Aclose(a);
    H5Oclose(o);
}

static bool is_link_name(const char *text) {
    return text[0] != '\0' && !strchr(text, '/') && strcmp(text, ".") != 0;
}

// Links keep the names that the objects in them have elsewhere.
static void rename_object(hid_t file, const char *path, const char *text) {
    char to[5000];
    const size_t n = (size_t)(strrchr(path, '/') + 1 - path);
    if (!is_link_name(text)) {
        return;
    }
    snprintf(to, sizeof to, "%.*s%s%s", (int)n, path, text, path + n);
    H5Lmove(file, path, file, to, H5P_DEFAULT, H5P_DEFAULT);
}

// Is the dataset one of ends of links, which are names of buildings?
static bool is_of_ends(const char *path) {
    const char *name = strrchr(path, '/');
    return name && (strcmp(name, "/left") == 0 || strcmp(name, "/right") == 0);
}

// Gives the ends of links the names that rename_object gives buildings.
static void rename_ends(hid_t file, const char *path, const char *text) {
    hid_t d = H5Dopen2(file, path, H5P_DEFAULT), type = H5Dget_type(d), space = H5Dget_space(d);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    char **list = malloc((size_t)(n + 1) * sizeof *list);
    char(*name)[5000] = malloc((size_t)(n + 1) * sizeof *name);
    assert_true(H5Dread(d, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, list) >= 0);
    for (hssize_t i = 0; i < n; i++) {
        const bool stays = !is_link_name(text) || strcmp(list[i], "wall") == 0;
        snprintf(name[i], sizeof name[i], "%s%s", stays ? "" : text, list[i]);
        list[i] = name[i];
    }
    assert_true(H5Dwrite(d, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, list) >= 0);
    free(name);
    free(list);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(d);
}

void foreign_text(const char *from, const char *to, int i, const char *text) {
    static struct foreign_field field[FOREIGN_FIELDS_MAX];
    const int n = foreign_fields(from, field);
    hid_t file = open_copy(from, to);
    // Names come last, as paths have them.
    for (int names = 0; names < 2; names++) {
        for (int k = 0; k < n; k++) {
            const char *path = field[k].path;
            if ((i >= 0 ? k != i : field[k].fixed) || names != (path[0] == '=')) {
                continue;
            }
            if (names) {
                rename_object(file, path + 1, text);
            } else if (i < 0 && is_of_ends(path)) {
                rename_ends(file, path, text);
            } else if (strchr(path, '@')) {
                write_attribute(file, path, text);
            } else {
                write_texts(file, path, text);
            }
        }
    }
    H5Fclose(file);
}

static herr_t visit_number(hid_t file, const char *name, const H5O_info_t *info, void *context) {
    if (info->type != H5O_TYPE_DATASET) {
        return 0;
    }
    hid_t d = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(d), space = H5Dget_space(d);
    if (H5Tget_class(type) == H5T_FLOAT) {
        const hssize_t n = H5Sget_simple_extent_npoints(space);
        double *list = malloc((size_t)(n + 1) * sizeof *list);
        for (hssize_t i = 0; i < n; i++) {
            list[i] = *(const double *)context;
        }
        assert_true(H5Dwrite(d, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, list) >= 0);
        free(list);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(d);
    return 0;
}

void foreign_numbers(const char *from, const char *to, double value) {
    hid_t file = open_copy(from, to);
    assert_true(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit_number, &value) >= 0);
    H5Fclose(file);
}

// Each chunk is the first one, as it is packed.
static void fill(hid_t file, const char *path, int n) {
    enum { CHUNK = 1000000 };
    static unsigned char packed[1 << 16];
    const hsize_t dim = (hsize_t)n * CHUNK, chunk = CHUNK, start = 0;
    hsize_t size;
    uint32_t filters;
    hid_t list = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(1, &dim, NULL);
    hid_t memory = H5Screate_simple(1, &chunk, NULL);
    double *zero = calloc(CHUNK, sizeof *zero);
    H5Pset_chunk(list, 1, &chunk);
    H5Pset_deflate(list, 9);
    hid_t d = H5Dcreate2(file, path, H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, NULL, &chunk, NULL);
    assert_true(H5Dwrite(d, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, zero) >= 0);
    free(zero);
    H5Fflush(file, H5F_SCOPE_LOCAL);
    assert_true(H5Dget_chunk_storage_size(d, &start, &size) >= 0 && size <= sizeof packed);
    assert_true(H5Dread_chunk(d, H5P_DEFAULT, &start, &filters, packed) >= 0);
    for (hsize_t at = chunk; at < dim; at += chunk) {
        assert_true(H5Dwrite_chunk(d, H5P_DEFAULT, filters, &at, (size_t)size, packed) >= 0);
    }
    H5Dclose(d);
    H5Sclose(memory);
    H5Sclose(space);
    H5Pclose(list);
}

void foreign_histories(const char *from, const char *to, int n) {
    static const char *const energies[] = {"input",   "kinetic",    "strain",   "damping",
                                           "contact", "hysteretic", "residual", "link"};
    hid_t file = open_copy(from, to);
    H5Ldelete(file, "time", H5P_DEFAULT);
    fill(file, "time", n);
    for (size_t i = 0; i < sizeof energies / sizeof energies[0]; i++) {
        char path[64];
        const double none = 0;
        snprintf(path, sizeof path, "energy/%s", energies[i]);
        if (H5Lexists(file, path, H5P_DEFAULT) > 0) {
            H5Ldelete(file, path, H5P_DEFAULT);
            fill(file, path, n);
            hid_t d = H5Dopen2(file, path, H5P_DEFAULT), one = H5Screate(H5S_SCALAR);
            hid_t a = H5Acreate2(d, "final", H5T_IEEE_F64LE, one, H5P_DEFAULT, H5P_DEFAULT);
            H5Awrite(a, H5T_NATIVE_DOUBLE, &none);
            H5Aclose(a);
            H5Sclose(one);
            H5Dclose(d);
        }
    }
    H5Fclose(file);
}
