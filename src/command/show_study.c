// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a study as its largest values, or as one long table: run, a column for each swept
// parameter, status, table, name, quantity, location, value, unit, hit. A failed run has one line
// there, whose value is its message.
#include "command/show_study.h"

#include <stdlib.h>

#include "command/study_print.h"

struct printer {
    const struct study_view *view;
    struct cells cells;
    struct study_peaks peaks;
};

void show_sweep_value(struct cells *c, const struct sweep *sweep, int k) {
    for (const struct sweep *s = sweep; s; s = s->along) {
        if (s->number) {
            cells_number(c, s->number[k]);
        } else {
            cells_text(c, s->label[k]);
        }
    }
}

void show_sweep_name(struct cells *c, const struct sweep *sweep) {
    for (const struct sweep *s = sweep; s; s = s->along) {
        cells_text(c, s->name);
    }
}

void show_sweep_cells(struct cells *c, const struct study_view *v, long number) {
    for (int i = 0; i < v->n_sweep; i++) {
        show_sweep_value(c, v->sweep[i], study_view_choice(v, number, i));
    }
}

void show_sweep_names(struct cells *c, const struct study_view *v) {
    for (int i = 0; i < v->n_sweep; i++) {
        show_sweep_name(c, v->sweep[i]);
    }
}

static void begin_line(struct printer *p, const struct study_run *r) {
    cells_whole(&p->cells, r->number + 1);
    show_sweep_cells(&p->cells, p->view, r->number);
    cells_text(&p->cells, study_print_status(r->outcome));
}

static void print_item(struct printer *p, const struct study_run *r,
                       const struct study_item *item) {
    for (size_t i = 0; i < item->n; i++) {
        begin_line(p, r);
        cells_text(&p->cells, item->parent);
        cells_text(&p->cells, study_print_name(p->view, item, i));
        cells_text(&p->cells, item->name);
        if (item->owner) {
            cells_whole(&p->cells, (long)i + 1);
        } else {
            cells_empty(&p->cells);
        }
        cells_number(&p->cells, r->value[item->first + i]);
        cells_text(&p->cells, item->units);
        cells_sign(&p->cells, study_view_hit(p->view, item, i, r->value));
        cells_end(&p->cells);
    }
}

static void print_failure(struct printer *p, const struct study_run *r) {
    begin_line(p, r);
    cells_text(&p->cells, "message");
    for (int i = 0; i < 3; i++) {
        cells_empty(&p->cells);
    }
    cells_text(&p->cells, r->outcome->message);
    cells_empty(&p->cells);
    cells_empty(&p->cells);
    cells_end(&p->cells);
}

static int take_lines(void *context, const struct study_run *r, struct error *e) {
    struct printer *p = context;
    (void)e;
    if (r->outcome->status != STUDY_DONE) {
        print_failure(p, r);
        return STATUS_OK;
    }
    for (int i = 0; i < p->view->table.n_item; i++) {
        print_item(p, r, &p->view->table.item[i]);
    }
    return STATUS_OK;
}

static int print_all(struct study_file *f, struct printer *p, struct error *e) {
    cells_words(&p->cells, "run");
    show_sweep_names(&p->cells, p->view);
    cells_words(&p->cells, "status table name quantity location value unit hit");
    cells_end(&p->cells);
    const int status = study_file_each(f, take_lines, p, e);
    cells_close(&p->cells);
    return status;
}

static int take_peaks(void *context, const struct study_run *r, struct error *e) {
    struct printer *p = context;
    (void)e;
    study_peaks_add(&p->peaks, p->view, r);
    return STATUS_OK;
}

static int print_summary(struct study_file *f, struct printer *p, struct error *e) {
    p->peaks.peak = calloc((size_t)p->view->table.n_item + 1, sizeof *p->peaks.peak);
    if (!p->peaks.peak) {
        return error_no_memory(e);
    }
    const int status = study_file_each(f, take_peaks, p, e);
    if (status == STATUS_OK) {
        study_peaks_print(&p->peaks, p->view, p->cells.to);
    }
    free(p->peaks.peak);
    return status;
}

typedef int print_function(struct study_file *f, struct printer *p, struct error *e);

static int show(const char *path, print_function *print, struct cells cells, struct error *e) {
    struct study_file *f;
    int status = study_file_open(path, &f, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct printer p = {.view = study_file_view(f), .cells = cells};
    status = print(f, &p, e);
    study_file_close(f);
    return status;
}

int show_study_summary(const char *path, FILE *to, struct error *e) {
    return show(path, print_summary, (struct cells){.to = to}, e);
}

int show_study(const char *path, enum cells_form form, FILE *to, struct error *e) {
    return show(path, print_all, (struct cells){.to = to, .form = form}, e);
}
