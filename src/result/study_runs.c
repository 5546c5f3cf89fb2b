// SPDX-License-Identifier: GPL-3.0-or-later
// What the runs of an open study file gave.
#include <stdlib.h>
#include <string.h>

#include "result/study_reader.h"
#include "result/study_sweep.h"

static void read_outcome(struct study_file *f, struct h5_box box, struct study_outcome *out) {
    int status = 0;
    struct h5_reference message = {.byte = {0}};
    h5_get_box(&f->file.h, f->status, &box, H5T_NATIVE_INT, &status);
    h5_get_box(&f->file.h, f->message, &box, f->file.h.heap.reference, &message);
    if (status < STUDY_DONE || status > STUDY_MISSING) {
        h5_fail(&f->file.h, "a run has the status %d", status);
        status = STUDY_MISSING;
    }
    *out = (struct study_outcome){.status = status};
    size_t n;
    const char *text = h5_heap_get(&f->file.h, &message, 1, &n);
    n = n < sizeof out->message ? n : sizeof out->message - 1;
    memcpy(out->message, text, n);
}

int study_file_read(struct study_file *f, long first, long n, struct study_outcome *outcome,
                    double *value, struct error *e) {
    for (long at = 0; at < n && !f->file.h.failed;) {
        const struct study_view *v = &f->view;
        const struct h5_box box = study_sweep_box(f->dim, f->n_dim, first + at, n - at);
        for (long i = 0; i < (long)box.n; i++) {
            read_outcome(f, study_sweep_box(f->dim, f->n_dim, first + at + i, 1), &outcome[at + i]);
        }
        for (int i = 0; i < v->table.n_item && !f->file.h.failed; i++) {
            const struct study_item *item = &v->table.item[i];
            h5_get_columns(&f->file.h, f->dataset[i], box, f->n_dim, item->n, v->table.n_value,
                           value + (size_t)at * v->table.n_value + item->first);
        }
        at += (long)box.n;
    }
    return f->file.h.failed ? h5_damaged(&f->file.h, f->view.path, e) : STATUS_OK;
}

int study_file_each(struct study_file *f, study_run_function *take, void *context,
                    struct error *e) {
    enum { BLOCK_RUNS = 256, BLOCK_VALUES = 1 << 21 };
    const struct study_view *v = &f->view;
    const size_t n_value = v->table.n_value + 1;
    const long most =
        n_value > BLOCK_VALUES / BLOCK_RUNS ? (long)(BLOCK_VALUES / n_value) + 1 : BLOCK_RUNS;
    struct study_outcome *outcome = malloc((size_t)most * sizeof *outcome);
    double *value = malloc((size_t)most * n_value * sizeof *value);
    int status = outcome && value ? STATUS_OK : error_no_memory(e);
    for (long first = 0; first < v->n_run && status == STATUS_OK; first += most) {
        const long left = v->n_run - first, n = left < most ? left : most;
        status = study_file_read(f, first, n, outcome, value, e);
        for (long i = 0; i < n && status == STATUS_OK; i++) {
            const struct study_run run = {study_view_run(v, first + i), &outcome[i],
                                          value + (size_t)i * v->table.n_value};
            status = take(context, &run, e);
        }
    }
    free(outcome);
    free(value);
    return status;
}
