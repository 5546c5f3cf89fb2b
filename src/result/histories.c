// SPDX-License-Identifier: GPL-3.0-or-later
// Reads single histories out of a result file: one column of a dataset over all rows.
#include <stdio.h>

#include "result/reader.h"

// True if the dataset is (n_row) or, for column >= 0, (n_row, more than column).
static bool shape_fits(hid_t space, long n_row, int column) {
    hsize_t dim[2] = {0, 0};
    const int n_dim = H5Sget_simple_extent_ndims(space);
    if (n_dim != (column < 0 ? 1 : 2) || H5Sget_simple_extent_dims(space, dim, NULL) < 0) {
        return false;
    }
    return dim[0] == (hsize_t)n_row && (column < 0 || dim[1] > (hsize_t)column);
}

static bool read_selected(hid_t dataset, hid_t space, long n_row, int column, double *out) {
    const hsize_t start[2] = {0, column < 0 ? 0 : (hsize_t)column};
    const hsize_t count[2] = {(hsize_t)n_row, 1};
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL) < 0) {
        return false;
    }
    hid_t memory = H5Screate_simple(1, count, NULL);
    if (memory < 0) {
        return false;
    }
    const herr_t result = H5Dread(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, out);
    H5Sclose(memory);
    return result >= 0;
}

static int read_column(const struct result_file *f, const char *path, int column, double *out,
                       struct error *e) {
    hid_t dataset = H5Dopen2(f->root, path, H5P_DEFAULT);
    if (dataset < 0) {
        return error_set(e, STATUS_INPUT, "%s has no dataset /%s; see output -fields", f->path,
                         path);
    }
    hid_t space = H5Dget_space(dataset), type = H5Dget_type(dataset);
    int status = STATUS_OK;
    if (space < 0 || H5Tget_class(type) != H5T_FLOAT ||
        !shape_fits(space, f->report->n_row, column) || !h5_is_stored(dataset)) {
        status = error_set(e, STATUS_INPUT, "%s is damaged: dataset /%s has the wrong shape",
                           f->path, path);
    } else if (!read_selected(dataset, space, f->report->n_row, column, out)) {
        status =
            error_set(e, STATUS_INPUT, "%s is damaged: dataset /%s cannot be read", f->path, path);
    }
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(dataset);
    return status;
}

int result_check_memory(const struct result_file *f, int n_column, struct error *e) {
    const double bytes = (double)f->report->n_row * n_column * (double)sizeof(double);
    const double limit = (double)h5_memory_limit(&f->h);
    return bytes <= limit
               ? STATUS_OK
               : error_set(e, STATUS_INPUT,
                           "%d histories of %s take %.3g MB of memory; at most %.3g MB are "
                           "allowed for a file of %.3g MB; write fewer rows (output -interval) or "
                           "take its compression away (h5repack -f NONE)",
                           n_column, f->path, bytes / 1e6, limit / 1e6,
                           (double)f->h.heap.end / 1e6);
}

int result_time(const struct result_file *f, double *out, struct error *e) {
    return read_column(f, "time", -1, out, e);
}

static int bit_index(enum field field) {
    int i = 0;
    while (i < FIELD_COUNT - 1 && !((unsigned)field >> i & 1)) {
        i++;
    }
    return i;
}

int result_floor_history(const struct result_file *f, enum field field, int building, int floor,
                         double *out, struct error *e) {
    char path[512];
    snprintf(path, sizeof path, "buildings/%s/%s", f->report->building[building].name,
             field_names[bit_index(field)]);
    return read_column(f, path, floor, out, e);
}

int result_contact_history(const struct result_file *f, enum field field, int contact, double *out,
                           struct error *e) {
    char path[512];
    snprintf(path, sizeof path, "contacts/%s", field_names[bit_index(field)]);
    return read_column(f, path, contact, out, e);
}

int result_link_history(const struct result_file *f, enum field field, int link, double *out,
                        struct error *e) {
    return read_column(f, field == FIELD_FORCE ? "links/force" : "links/deformation", link, out, e);
}

int result_ground(const struct result_file *f, int building, double *out, struct error *e) {
    char path[512];
    snprintf(path, sizeof path, "ground/%s", f->report->building[building].name);
    return read_column(f, path, -1, out, e);
}

int result_energy(const struct result_file *f, enum energy energy, double *out, struct error *e) {
    char path[64];
    snprintf(path, sizeof path, "energy/%s", energy_names[energy]);
    return read_column(f, path, -1, out, e);
}
