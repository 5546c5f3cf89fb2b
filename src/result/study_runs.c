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

static void read_values(struct study_file *f, struct h5_box box, double *value) {
    const struct study_table *t = &f->view.table;
    for (int i = 0; i < t->n_item && !f->file.h.failed; i++) {
        h5_get_columns(&f->file.h, f->dataset[i], box, f->n_dim, t->item[i].n, t->n_value,
                       value + t->item[i].first);
    }
}

int study_file_read(struct study_file *f, long first, long n, struct study_outcome *outcome,
                    double *value, struct error *e) {
    for (long at = 0; at < n && !f->file.h.failed;) {
        const struct study_view *v = &f->view;
        const struct h5_box box = study_sweep_box(f->dim, f->n_dim, first + at, n - at);
        for (long i = 0; i < (long)box.n; i++) {
            read_outcome(f, study_sweep_box(f->dim, f->n_dim, first + at + i, 1), &outcome[at + i]);
        }
        read_values(f, box, value + (size_t)at * v->table.n_value);
        at += (long)box.n;
    }
    return f->file.h.failed ? h5_damaged(&f->file.h, f->view.path, e) : STATUS_OK;
}

enum { BLOCK_RUNS = 256, BLOCK_VALUES = 1 << 21 };
struct block {
    long capacity;
    struct study_outcome *outcome;  // (capacity)
    double *value;                  // (capacity, n_value)
};

static int take_all(struct study_file *f, const struct block *b, study_run_function *take,
                    void *context, struct error *e) {
    const struct study_view *v = &f->view;
    int status = STATUS_OK;
    for (long first = 0; first < v->n_run && status == STATUS_OK; first += b->capacity) {
        const long left = v->n_run - first, n = left < b->capacity ? left : b->capacity;
        status = study_file_read(f, first, n, b->outcome, b->value, e);
        for (long i = 0; i < n && status == STATUS_OK; i++) {
            const struct study_run run = {study_view_run(v, first + i), &b->outcome[i],
                                          b->value + (size_t)i * v->table.n_value};
            status = take(context, &run, e);
        }
    }
    return status;
}

int study_file_each(struct study_file *f, study_run_function *take, void *context,
                    struct error *e) {
    const size_t n_value = f->view.table.n_value + 1;
    struct block b = {.capacity = n_value > BLOCK_VALUES / BLOCK_RUNS
                                      ? (long)(BLOCK_VALUES / n_value) + 1
                                      : BLOCK_RUNS};
    b.outcome = malloc((size_t)b.capacity * sizeof *b.outcome);
    b.value = malloc((size_t)b.capacity * n_value * sizeof *b.value);
    const int status =
        b.outcome && b.value ? take_all(f, &b, take, context, e) : error_no_memory(e);
    free(b.outcome);
    free(b.value);
    return status;
}
