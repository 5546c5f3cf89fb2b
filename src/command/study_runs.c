// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/study_runs.h"

#include <stdlib.h>

enum { BLOCK_RUNS = 256, BLOCK_VALUES = 1 << 21 };
struct block {
    long capacity;
    struct study_outcome *outcome;  // (capacity)
    double *value;                  // (capacity, n_value)
};

static int each(struct study_file *f, struct block *b,
                void (*take)(void *context, const struct study_run *r), void *context,
                struct error *e) {
    const struct study_view *v = study_file_view(f);
    int status = STATUS_OK;
    for (long first = 0; first < v->n_run && status == STATUS_OK; first += b->capacity) {
        const long left = v->n_run - first, n = left < b->capacity ? left : b->capacity;
        status = study_file_read(f, first, n, b->outcome, b->value, e);
        for (long i = 0; i < n && status == STATUS_OK; i++) {
            take(context, &(struct study_run){study_view_run(v, first + i), b->outcome[i],
                                              b->value + (size_t)i * v->table.n_value});
        }
    }
    return status;
}

int study_runs_each(struct study_file *f, void (*take)(void *context, const struct study_run *r),
                    void *context, struct error *e) {
    const size_t n_value = study_file_view(f)->table.n_value + 1;
    struct block b = {.capacity = n_value > BLOCK_VALUES / BLOCK_RUNS
                                      ? (long)(BLOCK_VALUES / n_value) + 1
                                      : BLOCK_RUNS};
    b.outcome = malloc((size_t)b.capacity * sizeof *b.outcome);
    b.value = malloc((size_t)b.capacity * n_value * sizeof *b.value);
    const int status = b.outcome && b.value ? each(f, &b, take, context, e) : error_no_memory(e);
    free(b.outcome);
    free(b.value);
    return status;
}

int study_runs_choice(const struct study_view *v, long number, int i) {
    for (int k = v->n_sweep - 1; k > i; k--) {
        number /= v->sweep[k]->n;
    }
    return (int)(number % v->sweep[i]->n);
}

const char *study_runs_status(const struct study_run *r) {
    switch (r->outcome.status) {
        case STUDY_DONE:
            return "done";
        case STUDY_FAILED:
            return "failed";
        default:
            return "missing";
    }
}
