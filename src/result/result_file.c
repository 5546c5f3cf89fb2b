// SPDX-License-Identifier: GPL-3.0-or-later
// An open result file: which run it is of, and its histories, one column of a dataset over all
// rows.
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "result/reader.h"
#include "result/seal.h"

enum { SIEVE_BYTES = 1 << 16 };

// The row of run `run` of the study in the file, from 0; a part says which runs it has. Errors:
// STATUS_INPUT (it does not have this one). A damaged file is noted in r->h.
static int find_row(struct result_file *r, const char *file, long run, hsize_t *row,
                    struct error *e) {
    *row = (hsize_t)run - 1;
    if (!h5_has(&r->h, r->h.file, "part")) {
        return STATUS_OK;
    }
    const size_t n = h5_get_length(&r->h, r->h.file, "run", STUDY_RUNS_MAX);
    const double *number = h5_get_doubles(&r->h, r->report->arena, r->h.file, "run", n);
    size_t i = 0;
    while (i < n && !r->h.failed && number[i] != (double)run) {
        i++;
    }
    *row = i;
    return r->h.failed || i < n
               ? STATUS_OK
               : error_set(e, STATUS_INPUT, "%s is part of a study and has no run %ld", file, run);
}

// Prepares for reading the values of run `run`, numbered from 1. Errors as of find_row.
static int find_run(struct result_file *r, const char *file, long run, struct error *e) {
    hsize_t dim[H5S_MAX_RANK], row, n_run = 1;
    int found = find_row(r, file, run, &row, e);
    if (found != STATUS_OK) {
        return found;
    }
    hid_t status = h5_open_object(&r->h, r->h.file, "status");
    hid_t space = r->h.failed ? -1 : H5Dget_space(status);
    const int n = space >= 0 ? H5Sget_simple_extent_dims(space, dim, NULL) : 0;
    if (n < 1 || n > STUDY_SWEEPS_MAX) {
        h5_fail(&r->h, "its runs have %d dimensions", n);
    }
    for (int i = n - 1; i >= 0 && !r->h.failed; i--) {
        r->h.front[i] = dim[i] > 0 ? row % dim[i] : 0;
        row /= dim[i] > 0 ? dim[i] : 1;
        n_run *= dim[i];
    }
    if (row > 0 && !r->h.failed) {
        found = error_set(e, STATUS_INPUT, "%s has no run %ld; its study has the runs 1 to %llu",
                          file, run, (unsigned long long)n_run);
    }
    r->h.n_front = r->h.failed ? 0 : n;
    h5_drop(space);
    h5_close(&r->h, status);
    return found;
}

// Opens the group of a run in a study. FILE#7 is the path of run 7 of FILE.
static int open_run(struct result_file *r, const char *file, long run, struct error *e) {
    char name[32];
    snprintf(name, sizeof name, "runs/%06ld", run);
    if (!h5_has(&r->h, r->h.file, "runs")) {
        return error_set(e, STATUS_INPUT,
                         "%s has no histories of single runs; 'output -histories' in the deck of a "
                         "study writes them",
                         file);
    }
    const int status = find_run(r, file, run, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!r->h.failed && !h5_has(&r->h, r->h.file, name)) {
        return error_set(e, STATUS_INPUT, "%s has no histories of run %ld", file, run);
    }
    r->root = h5_get_group(&r->h, r->h.file, name);
    r->report->run = run;
    return r->h.failed ? h5_damaged(&r->h, r->path, e) : STATUS_OK;
}

int reader_init(struct result_file *f, const char *path, enum reading reading, struct error *e) {
    struct arena *a = arena_create();
    struct report *r = a ? arena_alloc(a, 1, sizeof *r) : NULL;
    *f = (struct result_file){.h = {.file = -1}, .root = -1, .reading = reading};
    if (!r) {
        arena_free(a);
        return error_no_memory(e);
    }
    r->arena = a;
    f->report = r;
    f->path = arena_text(a, path, strlen(path));
    return f->path ? STATUS_OK : error_no_memory(e);
}

void reader_close(struct result_file *f) {
    h5_close_types(&f->h);
    if (f->root >= 0 && reader_is_run(f)) {
        h5_close(&f->h, f->root);
    }
    h5_close_file(&f->h);
    report_free(f->report);
}

int reader_open(struct result_file *r, const char *path, size_t sieve, struct error *e) {
    int status = h5_check_file(path, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (h5_start(&r->h) && H5Fis_hdf5(path) <= 0) {
        h5_fail(&r->h, "not an HDF5 file");
        return h5_lacks_memory(&r->h) ? error_no_memory(e)
                                      : error_set(e, STATUS_INPUT, "%s is %s", path, r->h.cause);
    }
    h5_open(&r->h, path, sieve);
    if (r->h.failed) {
        return h5_lacks_memory(&r->h)
                   ? error_no_memory(e)
                   : error_set(e, STATUS_INPUT, "cannot read %s: %s", path, r->h.cause);
    }
    r->root = r->h.file;
    const char *format = h5_get_text(&r->h, r->report->arena, r->root, "format");
    if (r->h.failed && h5_lacks_memory(&r->h)) {
        return error_no_memory(e);
    }
    if (!format || strcmp(format, "jostle") != 0) {
        return error_set(e, STATUS_INPUT, "%s is not a result file of jostle", path);
    }
    const long version = h5_get_long(&r->h, r->root, "format_version");
    const char *complete = h5_get_text(&r->h, r->report->arena, r->root, "status");
    if (r->h.failed) {
        return h5_damaged(&r->h, r->path, e);
    }
    if (version < 1 || version > RESULT_FORMAT_VERSION) {
        return error_set(e, STATUS_INPUT,
                         "%s has format version %ld; this program reads versions up to %d", path,
                         version, RESULT_FORMAT_VERSION);
    }
    return strcmp(complete, "complete") == 0
               ? STATUS_OK
               : error_set(e, STATUS_INPUT, "%s is not complete: its status is '%s'", path,
                           complete);
}

// The number after the last # of the path of a run in a study, and that of the study in *file; 0
// where the path is that of a file.
static long split(const struct result_file *r, const char **file) {
    const char *mark = strrchr(r->path, '#');
    char *end;
    *file = r->path;
    if (!mark || access(r->path, F_OK) == 0) {
        return 0;
    }
    const long run = strtol(mark + 1, &end, 10);
    if (mark[1] < '0' || mark[1] > '9' || *end != '\0' || run < 1) {
        return 0;
    }
    *file = arena_text(r->report->arena, r->path, (size_t)(mark - r->path));
    return run;
}

static int read_file(struct result_file *r, struct error *e) {
    const char *file;
    const long run = split(r, &file);
    int status = file ? reader_open(r, file, SIEVE_BYTES, e) : error_no_memory(e);
    if (status == STATUS_OK && run > 0) {
        status = open_run(r, file, run, e);
    } else if (status == STATUS_OK && h5_has(&r->h, r->root, "sweep")) {
        return error_set(e, STATUS_INPUT,
                         "%s is the result of a study, not of one analysis; "
                         "jostle show prints it",
                         file);
    }
    if (status != STATUS_OK) {
        return status;
    }
    reader_get(r);
    return r->h.failed ? h5_damaged(&r->h, r->path, e) : STATUS_OK;
}

int result_open(const char *path, struct result_file **out, struct error *e) {
    struct result_file *f = calloc(1, sizeof *f);
    if (!f) {
        return error_no_memory(e);
    }
    int status = reader_init(f, path, READ_VALUES, e);
    if (status == STATUS_OK) {
        assert(f->report);
        f->report->file = f->path;
        status = read_file(f, e);
    }
    if (status != STATUS_OK) {
        result_close(f);
        return status;
    }
    *out = f;
    return STATUS_OK;
}

void result_close(struct result_file *f) {
    if (f) {
        reader_close(f);
        free(f);
    }
}

const struct report *result_report(const struct result_file *f) {
    return f->report;
}

// Column `column` of a dataset (n_row, columns), or a dataset (n_row) where it is negative.
static int read_column(const struct result_file *f, const char *path, int column, double *out,
                       struct error *e) {
    hid_t dataset = H5Dopen2(f->root, path, H5P_DEFAULT);
    if (dataset < 0) {
        return error_set(e, STATUS_INPUT, "%s has no dataset /%s; see output -fields", f->path,
                         path);
    }
    struct h5 h = f->h;  // a history that is damaged leaves the others
    const int n_dim = column < 0 ? 1 : 2;
    const struct h5_box box = {.start = {0, column < 0 ? 0 : (hsize_t)column},
                               .count = {(hsize_t)f->report->n_row, 1}};
    hsize_t dim[H5S_MAX_RANK];
    hid_t space = H5Dget_space(dataset);
    const bool fits = H5Sget_simple_extent_dims(space, dim, NULL) == n_dim &&
                      dim[0] == box.count[0] && (column < 0 || dim[1] > box.start[1]);
    H5Sclose(space);
    if (!fits || !h5_is_number(dataset) || !h5_is_stored(dataset)) {
        h5_fail(&h, "dataset /%s has the wrong shape", path);
    }
    h5_get_box(&h, dataset, &box, H5T_NATIVE_DOUBLE, out);
    h5_close(&h, dataset);
    return h.failed ? h5_damaged(&h, f->path, e) : STATUS_OK;
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

static const char *name_of(int field) {
    int i = 0;
    while (i < FIELD_COUNT - 1 && !((unsigned)field >> i & 1)) {
        i++;
    }
    return field_names[i];
}

int result_history(const struct result_file *f, const struct history *h, double *out,
                   struct error *e) {
    const struct report *r = f->report;
    const bool of_building = h->kind == HISTORY_FLOOR || h->kind == HISTORY_GROUND;
    const char *building = of_building ? r->building[h->index].name : "";
    char path[512] = "time";
    int column = -1;
    switch (h->kind) {
        case HISTORY_TIME:
            break;
        case HISTORY_FLOOR:
            snprintf(path, sizeof path, "buildings/%s/%s", building, name_of(h->field));
            column = h->floor;
            break;
        case HISTORY_CONTACT:
            snprintf(path, sizeof path, "contacts/%s", name_of(h->field));
            column = h->index;
            break;
        case HISTORY_LINK:
            snprintf(path, sizeof path, "links/%s", layout_links.field[h->field != FIELD_FORCE]);
            column = h->index;
            break;
        case HISTORY_GROUND:
            snprintf(path, sizeof path, "ground/%s", building);
            break;
        case HISTORY_ENERGY:
            snprintf(path, sizeof path, "energy/%s", energy_names[h->field]);
            break;
    }
    return read_column(f, path, column, out, e);
}

int result_verify(const char *path, struct result_sums *out, struct error *e) {
    struct h5 h = {.file = -1, .lock = -1};
    int status = h5_check_file(path, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (h5_start(&h) && H5Fis_hdf5(path) == 0) {
        return error_set(e, STATUS_INPUT, "%s is not an HDF5 file", path);
    }
    h5_open(&h, path, 0);
    status = seal_check(&h, path, out, e);
    h5_close_types(&h);
    h5_close_file(&h);
    return status;
}
