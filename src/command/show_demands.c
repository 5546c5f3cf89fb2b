// SPDX-License-Identifier: GPL-3.0-or-later
// The demand parameters of a study: all that the file has at all their places, or those asked for.
// In long form they have a line each: a column for each swept parameter, edp, location, value,
// unit, status, hit. In wide form a run has a line: its number, the swept parameters, its status,
// and a column for each demand. The value of a failed run is empty. Intensities of the ground
// motions stand behind the swept parameters.
#include "command/show.h"

#include <math.h>

#include "command/study_deck.h"
#include "command/study_print.h"
#include "core/arena.h"
#include "study/edp.h"

enum demand_form { DEMAND_EVERYWHERE, DEMAND_REDUCED };
struct show {
    const struct study_view *view;
    struct printer table;
    enum demand_form form;
    bool wide;
    const struct edp *edp;  // (n_edp)
    int n_edp;
    const struct measure *measure;  // (n_measure) of the ground motions
    int n_measure;
    const double *intensity;  // (n_run of the file, n_measure)
    long row;                 // of the file: the next run
};

// The sweeps of the next run of the file and its intensities, as coordinates.
static void print_coordinates(struct show *p, long row, const struct study_run *r) {
    show_sweeps(&p->table, p->view, r->number);
    for (int i = 0; i < p->n_measure; i++) {
        const double x = p->intensity[row * p->n_measure + i];
        if (isnan(x)) {
            printer_empty(&p->table);
        } else {
            printer_number(&p->table, x);
        }
    }
}

static void print_line(struct show *p, const struct study_run *r, const struct edp *edp, int at,
                       const char *location, double value) {
    const bool done = r->outcome->status == STUDY_DONE;
    print_coordinates(p, p->row, r);
    printer_text(&p->table, p->form == DEMAND_REDUCED ? edp->text : edp->quantity->name);
    printer_text(&p->table, location);
    if (done) {
        printer_number(&p->table, value);
    } else {
        printer_empty(&p->table);
    }
    printer_text(&p->table, edp->units);
    printer_text(&p->table, study_print_status(r->outcome));
    printer_sign(&p->table, done ? edp_hit(edp, p->view, at, r->value) : -1);
    printer_line(&p->table);
}

// Columns of one demand: one, or one for each of its places, "drift:A:3 [m]".
static int add_columns(struct show *p, const struct edp *edp, struct arena *a, struct error *e) {
    const int n = p->form == DEMAND_EVERYWHERE ? edp->n_term : 1;
    for (int i = 0; i < n; i++) {
        const char *name = edp->quantity->name, *location = edp->term[i].location;
        const char *head = arena_format(a, "%s%s%s", name, location[0] ? ":" : "", location);
        if (!head) {
            return error_no_memory(e);
        }
        printer_add(&p->table,
                    &(struct printer_column){.key = p->form == DEMAND_EVERYWHERE ? head : edp->text,
                                             .unit = unit_suffix(edp->units)},
                    1);
    }
    return STATUS_OK;
}

static int take_wide(void *context, const struct study_run *r, struct error *e) {
    struct show *p = context;
    (void)e;
    printer_whole(&p->table, r->number + 1);
    print_coordinates(p, p->row++, r);
    printer_text(&p->table, study_print_status(r->outcome));
    for (int k = 0; k < p->n_edp && r->outcome->status == STUDY_DONE; k++) {
        const struct edp *edp = &p->edp[k];
        int at;
        if (p->form == DEMAND_REDUCED) {
            printer_number(&p->table, edp_value(edp, r->value, &at));
        }
        for (int i = 0; i < edp->n_term && p->form == DEMAND_EVERYWHERE; i++) {
            printer_number(&p->table, edp_term_value(edp, i, r->value));
        }
    }
    printer_line(&p->table);
    return STATUS_OK;
}

static int take(void *context, const struct study_run *r, struct error *e) {
    struct show *p = context;
    (void)e;
    for (int k = 0; k < p->n_edp; k++) {
        const struct edp *edp = &p->edp[k];
        if (p->form == DEMAND_EVERYWHERE) {
            for (int i = 0; i < edp->n_term; i++) {
                print_line(p, r, edp, i, edp->term[i].location, edp_term_value(edp, i, r->value));
            }
            continue;
        }
        int at;
        const double value = edp_value(edp, r->value, &at);
        const bool placed = r->outcome->status == STUDY_DONE &&
                            (edp->quantity->reduction != EDP_SUM || edp->n_term == 1);
        print_line(p, r, edp, at, placed ? edp->term[at].location : "", value);
    }
    p->row++;
    return STATUS_OK;
}

// Quantities that the file does not have are left out where all are asked for.
static int read_demands(const struct study_view *v, const struct show_demands_request *q,
                        struct arena *a, struct edp *edp, int *n, struct error *e) {
    const int n_asked = q->n_edp > 0 ? q->n_edp : n_edp_quantity;
    for (int i = 0; i < n_asked; i++) {
        const char *text = q->n_edp > 0 ? q->edp[i] : edp_quantities[i].name;
        const int status = edp_parse(v, text, a, &edp[*n], e);
        if (status != STATUS_OK && (q->n_edp > 0 || status != STATUS_INPUT)) {
            return status;
        }
        *n += status == STATUS_OK;
    }
    return STATUS_OK;
}

static int add_head(struct show *p, struct arena *a, struct error *e) {
    static const struct printer_column run[] = {COLUMN_DATA("run")};
    static const struct printer_column outcome[] = {COLUMN_DATA("status")};
    static const struct printer_column demand[] = {COLUMN_DATA("edp"),    COLUMN_DATA("location"),
                                                   COLUMN_DATA("value"),  COLUMN_DATA("unit"),
                                                   COLUMN_DATA("status"), COLUMN_DATA("hit")};
    if (p->wide) {
        PRINTER_ADD(&p->table, run);
    }
    show_add_sweeps(&p->table, p->view);
    for (int i = 0; i < p->n_measure; i++) {
        const struct measure *m = &p->measure[i];
        printer_add(&p->table,
                    &(struct printer_column){.key = m->text, .unit = unit_suffix(m->units)}, 1);
    }
    if (p->wide) {
        PRINTER_ADD(&p->table, outcome);
    } else {
        PRINTER_ADD(&p->table, demand);
    }
    int status = STATUS_OK;
    for (int k = 0; k < p->n_edp && p->wide && status == STATUS_OK; k++) {
        status = add_columns(p, &p->edp[k], a, e);
    }
    return status;
}

// The intensities that are asked for. EXIT_DONE or, after a message, the exit status.
static int find_intensities(struct show *p, struct study_file *f,
                            const struct show_demands_request *q, struct arena *a) {
    const size_t n = (size_t)q->n_im;
    struct measure *measure = arena_alloc(a, n, sizeof *measure);
    double *value = arena_alloc(a, n * (size_t)p->view->n_run, sizeof *value);
    struct error e;
    int status = measure && value ? STATUS_OK : error_no_memory(&e);
    for (int i = 0; i < q->n_im && status == STATUS_OK; i++) {
        status = measure_parse(&p->view->units, q->im[i], a, &measure[i], &e);
    }
    p->measure = measure;
    p->n_measure = q->n_im;
    p->intensity = value;
    return status == STATUS_OK ? study_deck_measure(f, q->deck, measure, q->n_im, value)
                               : command_fail(&e);
}

static int print_all(struct show *p, struct study_file *f, const struct show_demands_request *q,
                     struct arena *a, struct edp *edp) {
    struct error e;
    int status = read_demands(p->view, q, a, edp, &p->n_edp, &e);
    if (status == STATUS_OK) {
        status = add_head(p, a, &e);
    }
    if (status == STATUS_OK) {
        printer_head(&p->table);
        status = study_file_each(f, p->wide ? take_wide : take, p, &e);
    }
    status = printer_end(&p->table, status, &e);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int show(struct study_file *f, const struct show_demands_request *q, FILE *to) {
    struct arena *a = arena_create();
    struct edp *edp =
        a ? arena_alloc(a, (size_t)q->n_edp + (size_t)n_edp_quantity, sizeof *edp) : NULL;
    struct show p = {.view = study_file_view(f),
                     .table = {.to = to, .form = q->form},
                     .form = q->n_edp > 0 ? DEMAND_REDUCED : DEMAND_EVERYWHERE,
                     .wide = q->wide,
                     .edp = edp};
    int status = edp ? EXIT_DONE : command_no_memory();
    if (status == EXIT_DONE && q->n_im > 0) {
        status = find_intensities(&p, f, q, a);
    }
    status = status == EXIT_DONE ? print_all(&p, f, q, a, edp) : status;
    arena_free(a);
    return status;
}

int show_demands(const char *path, const struct show_demands_request *q, FILE *to) {
    struct study_file *f;
    struct error e;
    if (study_file_open(path, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const int status = show(f, q, to);
    study_file_close(f);
    return status;
}
