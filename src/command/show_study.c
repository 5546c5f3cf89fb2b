// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a study as one long table: run, a column for each swept parameter, status, table,
// name, quantity, location, value, unit. A failed run has one line, whose value is its message.
#include "command/show_study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command/study_print.h"

// One run at a time.
struct run {
    long number;  // in the study, from 0
    struct study_outcome outcome;
    const double *value;  // (n_value)
};

// Runs are read in blocks.
enum { BLOCK_RUNS = 256, BLOCK_VALUES = 1 << 21 };
struct block {
    long capacity;
    struct study_outcome *outcome;  // (capacity)
    double *value;                  // (capacity, n_value)
};

static void begin_line(const struct study_view *v, const struct run *r, FILE *to) {
    static const char *const ends[] = {"done\t", "failed\t", "missing\t"};
    fprintf(to, "%ld\t", r->number + 1);
    long later = v->n_study;
    for (int i = 0; i < v->n_sweep; i++) {
        const struct sweep *s = v->sweep[i];
        later /= s->n;
        const long k = r->number / later % s->n;
        for (const struct sweep *p = s; p; p = p->along) {
            if (p->number) {
                fprintf(to, "%.17g\t", p->number[k]);
            } else {
                study_print_text(p->label[k], to);
                fputc('\t', to);
            }
        }
    }
    fputs(ends[r->outcome.status], to);
}

static void print_item(const struct study_view *v, const struct run *r,
                       const struct study_item *item, FILE *to) {
    for (size_t i = 0; i < item->n; i++) {
        begin_line(v, r, to);
        fprintf(to, "%s\t", item->parent);
        study_print_text(study_print_name(v, item, i), to);
        fprintf(to, "\t%s\t", item->name);
        if (item->owner) {
            fprintf(to, "%zu", i + 1);
        }
        fprintf(to, "\t%.17g\t%s\n", r->value[item->first + i], item->units);
    }
}

static void print_run(const struct study_view *v, const struct run *r, FILE *to) {
    if (r->outcome.status != STUDY_DONE) {
        begin_line(v, r, to);
        fputs("message\t\t\t\t", to);
        study_print_text(r->outcome.message, to);
        fputs("\t\n", to);
        return;
    }
    for (int i = 0; i < v->table.n_item; i++) {
        print_item(v, r, &v->table.item[i], to);
    }
}

static void print_head(const struct study_view *v, FILE *to) {
    fputs("run\t", to);
    for (int i = 0; i < v->n_sweep; i++) {
        for (const struct sweep *p = v->sweep[i]; p; p = p->along) {
            fprintf(to, "%s\t", p->name);
        }
    }
    fputs("status\ttable\tname\tquantity\tlocation\tvalue\tunit\n", to);
}

// Calls `take` for each run in turn.
static int each_run(struct study_file *f, struct block *b,
                    void (*take)(void *context, const struct run *r), void *context,
                    struct error *e) {
    const struct study_view *v = study_file_view(f);
    int status = STATUS_OK;
    for (long first = 0; first < v->n_run && status == STATUS_OK; first += b->capacity) {
        const long left = v->n_run - first, n = left < b->capacity ? left : b->capacity;
        status = study_file_read(f, first, n, b->outcome, b->value, e);
        for (long i = 0; i < n && status == STATUS_OK; i++) {
            take(context, &(struct run){study_view_run(v, first + i), b->outcome[i],
                                        b->value + (size_t)i * v->table.n_value});
        }
    }
    return status;
}

// Prints the table, or collects what the summary tells.
struct printer {
    const struct study_view *view;
    FILE *to;
    struct study_peaks peaks;
};

static void take_line(void *context, const struct run *r) {
    const struct printer *p = context;
    print_run(p->view, r, p->to);
}

static void take_peaks(void *context, const struct run *r) {
    struct printer *p = context;
    study_peaks_add(&p->peaks, p->view, r->number, &r->outcome, r->value);
}

static int print(struct study_file *f, enum study_form form, struct block *b, FILE *to,
                 struct error *e) {
    struct printer p = {.view = study_file_view(f), .to = to};
    if (form == STUDY_TSV) {
        print_head(p.view, to);
        return each_run(f, b, take_line, &p, e);
    }
    p.peaks.peak = calloc((size_t)p.view->table.n_item + 1, sizeof *p.peaks.peak);
    if (!p.peaks.peak) {
        return error_no_memory(e);
    }
    int status = each_run(f, b, take_peaks, &p, e);
    if (status == STATUS_OK) {
        study_peaks_print(&p.peaks, p.view, to);
    }
    free(p.peaks.peak);
    return status;
}

int show_study(const char *path, enum study_form form, FILE *to, struct error *e) {
    struct study_file *f;
    int status = study_file_open(path, &f, e);
    if (status != STATUS_OK) {
        return status;
    }
    const size_t n_value = study_file_view(f)->table.n_value + 1;
    struct block b = {.capacity = n_value > BLOCK_VALUES / BLOCK_RUNS
                                      ? (long)(BLOCK_VALUES / n_value) + 1
                                      : BLOCK_RUNS};
    b.outcome = malloc((size_t)b.capacity * sizeof *b.outcome);
    b.value = malloc((size_t)b.capacity * n_value * sizeof *b.value);
    status = b.outcome && b.value ? print(f, form, &b, to, e) : error_no_memory(e);
    free(b.outcome);
    free(b.value);
    study_file_close(f);
    return status;
}
