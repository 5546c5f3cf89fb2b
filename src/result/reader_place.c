// SPDX-License-Identifier: GPL-3.0-or-later
// Where the values of one analysis are: in a file of its own all in one tree; of a run of a study
// histories and impacts in /runs, and what runs have in common or with the dimensions of the sweeps
// in front in the tree of the study.
#include "result/reader.h"

bool reader_is_run(const struct result_file *f) {
    return f->root != f->h.file;
}

struct reader_place reader_place_root(const struct result_file *f) {
    return (struct reader_place){f->root, reader_is_run(f) ? f->h.file : -1};
}

hid_t reader_place_holder(struct result_file *f, const struct reader_place *p, const char *name) {
    const bool is_own = p->study < 0 || (p->own >= 0 && h5_has(&f->h, p->own, name));
    return is_own ? p->own : p->study;
}

struct reader_place reader_place_open(struct result_file *f, const struct reader_place *in,
                                      const char *name) {
    const bool is_own = reader_place_holder(f, in, name) == in->own;
    return (struct reader_place){is_own ? h5_get_group(&f->h, in->own, name) : -1,
                                 in->study >= 0 ? h5_get_group(&f->h, in->study, name) : -1};
}

void reader_place_close(struct result_file *f, const struct reader_place *p) {
    h5_close(&f->h, p->own);
    h5_close(&f->h, p->study);
}

// The row of run `run` of the study in the file, from 0; a part says which runs it has.
static hsize_t find_row(struct result_file *f, long run) {
    if (!h5_has(&f->h, f->h.file, "part")) {
        return (hsize_t)run - 1;
    }
    const size_t n = h5_get_length(&f->h, f->h.file, "run", STUDY_RUNS_MAX);
    const double *number = h5_get_doubles(&f->h, f->report->arena, f->h.file, "run", n);
    for (size_t i = 0; i < n && !f->h.failed; i++) {
        if (number[i] == (double)run) {
            return i;
        }
    }
    h5_fail(&f->h, "it does not say where run %ld is", run);
    return 0;
}

void reader_place_find(struct result_file *f, long run) {
    hsize_t dim[H5S_MAX_RANK], row = find_row(f, run);
    hid_t status = h5_open_object(&f->h, f->h.file, "status");
    hid_t space = f->h.failed ? -1 : H5Dget_space(status);
    const int n = space >= 0 ? H5Sget_simple_extent_dims(space, dim, NULL) : 0;
    if (n < 1 || n > STUDY_SWEEPS_MAX) {
        h5_fail(&f->h, "its runs have %d dimensions", n);
    }
    for (int i = n - 1; i >= 0 && !f->h.failed; i--) {
        f->h.front[i] = dim[i] > 0 ? row % dim[i] : 0;
        row /= dim[i] > 0 ? dim[i] : 1;
    }
    if (row > 0) {
        h5_fail(&f->h, "it has no run %ld", run);
    }
    f->h.n_front = f->h.failed ? 0 : n;
    if (space >= 0) {
        H5Sclose(space);
    }
    h5_close(&f->h, status);
}
