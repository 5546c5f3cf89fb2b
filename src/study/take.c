// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/take.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "jostle/study_merge.h"
#include "study/trial.h"

enum { BYTES_MAX = 1 << 20, ROWS_MAX = 256 };

int take_open(struct take_file *t, const char *path, struct error *e) {
    *t = (struct take_file){.file = NULL};
    const int status = study_file_open(path, &t->file, e);
    if (status != STATUS_OK) {
        return status;
    }
    t->view = study_file_view(t->file);
    return study_file_verify(t->file, e);
}

void take_close(struct take_file *t) {
    study_file_close(t->file);
    free(t->item);
    free(t->outcome);
    free(t->value);
    *t = (struct take_file){.file = NULL};
}

static bool is_swept(const struct sweep *sweeps, const char *name) {
    for (const struct sweep *s = sweeps; s; s = s->next) {
        for (const struct sweep *v = s; v; v = v->along) {
            if (!s->fixed && strcmp(v->name, name) == 0) {
                return true;
            }
        }
    }
    return false;
}

int take_map(struct take_file *t, const struct study_table *table, const struct sweep *sweeps,
             struct error *e) {
    const size_t n_value = t->view->table.n_value + 1,
                 rows = BYTES_MAX / (n_value * sizeof(double));
    t->table = table;
    t->capacity = rows < 1 ? 1 : rows > ROWS_MAX ? ROWS_MAX : (long)rows;
    t->item = malloc(((size_t)table->n_item + 1) * sizeof *t->item);
    t->outcome = malloc((size_t)t->capacity * sizeof *t->outcome);
    t->value = malloc((size_t)t->capacity * n_value * sizeof *t->value);
    if (!t->item || !t->outcome || !t->value) {
        return error_no_memory(e);
    }
    for (int i = 0; i < table->n_item; i++) {
        const struct study_item *item = &table->item[i];
        t->item[i] = item->n > 0 ? study_table_find(&t->view->table, item) : -1;
        const bool missing = t->item[i] < 0 && item->n > 0 && !is_swept(sweeps, item->name);
        if (missing && !item->property) {
            return error_set(e, STATUS_INPUT, "%s does not have %s/%s", t->view->path, item->parent,
                             item->name);
        }
        t->lacks = t->lacks || missing;
    }
    return STATUS_OK;
}

// Blocks start at multiples of their size, so that rows may be wanted in falling order too.
static int read_block(struct take_file *t, long row, struct error *e) {
    const long first = row - row % t->capacity, left = t->view->n_run - first;
    if (t->n > 0 && row >= t->first && row < t->first + t->n) {
        return STATUS_OK;
    }
    t->first = first;
    t->n = left < t->capacity ? left : t->capacity;
    const int status = study_file_read(t->file, first, t->n, t->outcome, t->value, e);
    t->n = status == STATUS_OK ? t->n : 0;
    return status;
}

int take_row(struct take_file *t, long row, struct study_outcome *outcome, double *value,
             struct error *e) {
    const struct study_table *from = &t->view->table;
    const int status = read_block(t, row, e);
    if (status != STATUS_OK) {
        return status;
    }
    const double *source = t->value + (size_t)(row - t->first) * from->n_value;
    *outcome = t->outcome[row - t->first];
    for (int i = 0; i < t->table->n_item; i++) {
        const struct study_item *item = &t->table->item[i];
        for (size_t k = 0; k < item->n; k++) {
            value[item->first + k] =
                t->item[i] < 0 ? NAN : source[from->item[t->item[i]].first + k];
        }
    }
    return STATUS_OK;
}

// A run whose properties are filled in.
struct filling {
    const struct take_file *from;
    double *value;  // (n_value)
};

static int fill(void *context, const struct model *m, struct study_outcome *outcome,
                struct error *e) {
    const struct filling *f = context;
    const struct study_table *t = f->from->table;
    struct report *report = NULL;
    double *all = malloc((t->n_value + 1) * sizeof *all);
    (void)outcome;
    if (!all) {
        return error_no_memory(e);
    }
    const int status = report_create(m, NULL, NULL, "", &report, e);
    if (status == STATUS_OK) {
        study_table_read(report, all);
        report_free(report);
    }
    for (int i = 0; i < t->n_item && status == STATUS_OK; i++) {
        const struct study_item *item = &t->item[i];
        for (size_t k = 0; f->from->item[i] < 0 && item->property && k < item->n; k++) {
            f->value[item->first + k] = all[item->first + k];
        }
    }
    free(all);
    return status;
}

int take_fill(const struct take_file *t, const struct plan *p, long run,
              struct record_cache *records, double *value, struct error *e) {
    const struct trial_watch watch = {.records = records};
    struct filling filling = {t, value};
    struct study_outcome built;
    return trial_build(p, study_shard_run(&p->shard, run), &watch, fill, &filling, &built, e);
}
