// SPDX-License-Identifier: GPL-3.0-or-later
// The file of a study as its largest values, or as one long table: run, a column for each swept
// parameter, status, table, name, quantity, location, value, unit, hit. A failed run has one line
// there, whose value is its message.
#include "command/show.h"

#include <stdlib.h>

#include "command/study_print.h"

struct show {
    const struct study_view *view;
    struct printer table;
    struct study_peaks peaks;
};

void show_add_sweeps(struct printer *t, const struct study_view *v) {
    for (int i = 0; i < v->n_sweep; i++) {
        printer_add_sweep(t, v->sweep[i]);
    }
}

void show_sweeps(struct printer *t, const struct study_view *v, long number) {
    for (int i = 0; i < v->n_sweep; i++) {
        printer_sweep(t, v->sweep[i], study_view_choice(v, number, i));
    }
}

static void begin_line(struct show *p, const struct study_run *r) {
    printer_whole(&p->table, r->number + 1);
    show_sweeps(&p->table, p->view, r->number);
    printer_text(&p->table, study_print_status(r->outcome));
}

static void print_item(struct show *p, const struct study_run *r, const struct study_item *item) {
    for (size_t i = 0; i < item->n; i++) {
        begin_line(p, r);
        printer_text(&p->table, item->parent);
        printer_text(&p->table, study_print_name(p->view, item, i));
        printer_text(&p->table, item->name);
        if (item->owner) {
            printer_whole(&p->table, (long)i + 1);
        } else {
            printer_empty(&p->table);
        }
        printer_number(&p->table, r->value[item->first + i]);
        printer_text(&p->table, item->units);
        printer_sign(&p->table, study_view_hit(p->view, item, i, r->value));
        printer_line(&p->table);
    }
}

static int take_lines(void *context, const struct study_run *r, struct error *e) {
    struct show *p = context;
    (void)e;
    if (r->outcome->status != STUDY_DONE) {
        begin_line(p, r);
        printer_text(&p->table, "message");
        for (int i = 0; i < 3; i++) {
            printer_empty(&p->table);
        }
        printer_text(&p->table, r->outcome->message);
        printer_line(&p->table);
        return STATUS_OK;
    }
    for (int i = 0; i < p->view->table.n_item; i++) {
        print_item(p, r, &p->view->table.item[i]);
    }
    return STATUS_OK;
}

static int print_all(struct study_file *f, struct show *p, struct error *e) {
    static const struct printer_column run[] = {COLUMN_DATA("run")};
    static const struct printer_column value[] = {
        COLUMN_DATA("status"),   COLUMN_DATA("table"), COLUMN_DATA("name"), COLUMN_DATA("quantity"),
        COLUMN_DATA("location"), COLUMN_DATA("value"), COLUMN_DATA("unit"), COLUMN_DATA("hit")};
    PRINTER_ADD(&p->table, run);
    show_add_sweeps(&p->table, p->view);
    PRINTER_ADD(&p->table, value);
    printer_head(&p->table);
    return printer_end(&p->table, study_file_each(f, take_lines, p, e), e);
}

static int take_peaks(void *context, const struct study_run *r, struct error *e) {
    struct show *p = context;
    (void)e;
    study_peaks_add(&p->peaks, p->view, r);
    return STATUS_OK;
}

static int print_summary(struct study_file *f, struct show *p, struct error *e) {
    p->peaks.peak = calloc((size_t)p->view->table.n_item + 1, sizeof *p->peaks.peak);
    if (!p->peaks.peak) {
        return error_no_memory(e);
    }
    const int status = study_file_each(f, take_peaks, p, e);
    if (status == STATUS_OK) {
        study_peaks_print(&p->peaks, p->view, p->table.to);
    }
    free(p->peaks.peak);
    return status;
}

typedef int print_function(struct study_file *f, struct show *p, struct error *e);

static int show(const char *path, print_function *print, struct printer table, struct error *e) {
    struct study_file *f;
    int status = study_file_open(path, &f, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct show p = {.view = study_file_view(f), .table = table};
    status = print(f, &p, e);
    study_file_close(f);
    return status;
}

int show_study_summary(const char *path, FILE *to, struct error *e) {
    return show(path, print_summary, (struct printer){.to = to}, e);
}

int show_study(const char *path, enum printer_form form, FILE *to, struct error *e) {
    return show(path, print_all, (struct printer){.to = to, .form = form}, e);
}
