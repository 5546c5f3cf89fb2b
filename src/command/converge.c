// SPDX-License-Identifier: GPL-3.0-or-later
// jostle converge: a deck at ever shorter steps, and what that says of the error of its results.

#include <math.h>

#include "command/deck_command.h"
#include "command/printer.h"
#include "command/progress.h"
#include "command/sweeps.h"
#include "core/safe.h"
#include "study/refinement.h"

static int converge_command(int argc, char **argv);

const struct command command_converge = {
    .name = "converge",
    .usage = "DECK [-D NAME=VALUE]... [-n LEVELS] [--rtol R] [--tsv|--csv|--json]",
    .summary = "runs a deck with halved steps and prints the errors of its results",
    .run = converge_command,
};

enum { LEVELS_DEFAULT = 4 };
static const double RTOL_DEFAULT = 1e-3;

struct options {
    struct load_request load;
    int n_level;
    double rtol;
    enum printer_form form;
};
#define AT(member) offsetof(struct options, member)

enum { SHOWN_MAX = 20, LABEL_WIDTH = 23, SHOWN_LEVELS = 3 };

// Behind the levels in text; before and behind them in data.
static const struct printer_column orders[] = {
    COLUMN_F("order", 5, 2),
    COLUMN_G("estimate", 11, 6),
    {.head = "rel. err.", .width = 9, .digits = 1, .look = LOOK_E},
    COLUMN_TEXT("converged", 0)};
static const struct printer_column of_result[] = {COLUMN_DATA("owner"), COLUMN_DATA("name"),
                                                  COLUMN_DATA("quantity"), COLUMN_DATA("unit")};
static const struct printer_column of_convergence[] = {
    COLUMN_DATA("order"), COLUMN_DATA("estimate"), COLUMN_DATA("error"), COLUMN_DATA("converged"),
    COLUMN_DATA("reason")};

// A contact and a link between the same floors have the same name, if the deck gives none.
static const char *owner_of(const struct model *m, const struct refined *f) {
    return f->owner == OF_MODEL          ? "model"
           : f->owner == OF_BUILDING     ? "building"
           : m->link[f->index].bilateral ? "link"
                                         : "contact";
}

static const char *name_of(const struct model *m, const struct refined *f) {
    return f->owner == OF_BUILDING ? m->building[f->index].name
           : f->owner == OF_LINK   ? m->link[f->index].name
                                   : "";
}

static const char *unit_of(const struct model *m, const struct refined *f, char *text,
                           size_t size) {
    if (!f->dimension) {
        return "1";
    }
    unit_text(&m->deck->units, *f->dimension, text, size);
    return text;
}

// Why a result has not converged, or may seem not to.
static const char *reason_of(const struct refined *f) {
    if (f->within) {
        return "";
    }
    if (f->impacts_change || f->convergence.kind == CONVERGENCE_MISCOUNT) {
        return "the number of impacts changes";
    }
    switch (f->convergence.kind) {
        case CONVERGENCE_IRREGULAR:
            return "no order: the differences do not shrink steadily";
        case CONVERGENCE_FAST:
            return "the order is higher than the method's, so not to be trusted";
        default:
            return "the step is too long";
    }
}

// Halvings of the step that the order promises to be enough; 0: it promises nothing.
static double halvings(const struct refined *f, double finest, double rtol) {
    const struct convergence *c = &f->convergence;
    if (f->within || c->kind != CONVERGENCE_ORDERLY || f->impacts_change) {
        return 0.0;
    }
    return ceil(log2(c->error / (rtol * fabs(finest))) / c->order);
}

// Values are divided by `size`, that of `unit` in the deck's; an empty unit is none.
static void print_row(struct printer *t, const struct refinement *r, const struct refined *f,
                      const char *unit, double size) {
    const struct convergence *c = &f->convergence;
    const double *last = f->value + r->n_level - 1;
    char label[96];
    snprintf(label, sizeof label, unit[0] ? "%s [%s]" : "%s", f->quantity, unit);
    printer_text(t, label);
    for (int i = SHOWN_LEVELS - 1; i >= 0; i--) {
        printer_number(t, last[-i] / size);
    }
    printer_number(t, c->order);
    printer_number(t, c->estimate / size);
    printer_number(t, c->error != 0.0 ? c->error / fabs(*last) : 0.0);
    printer_text(t, f->within ? "yes" : "no");
    printer_line(t);
}

static void print_heading(struct printer *t, const struct refinement *r, const struct model *m) {
    const char *unit = m->adaptive ? " " : m->deck->units.time_name;
    struct printer_column level[SHOWN_LEVELS];
    char head[SHOWN_LEVELS][48];
    if (m->deck->title[0]) {
        safe_line(stdout, "%s", m->deck->title);
    }
    sweeps_print_first(m->deck, "", "");
    printf("%d levels, %s", r->n_level, m->adaptive ? "tolerances" : "steps");
    for (int i = 0; i < r->n_level; i++) {
        printf(" %.6g", r->step[i]);
    }
    printf(" %s\n\n", unit);
    for (int i = 0; i < SHOWN_LEVELS; i++) {
        const double step = r->step[r->n_level - SHOWN_LEVELS + i];
        snprintf(head[i], sizeof head[i], "%.4g %s", step, unit);
        level[i] = (struct printer_column)COLUMN_G(head[i], 11, 6);
    }
    printer_add(t,
                &(struct printer_column)COLUMN_TEXT(
                    m->adaptive ? "at a tolerance of" : "at a step of", -LABEL_WIDTH),
                1);
    PRINTER_ADD(t, level);
    PRINTER_ADD(t, orders);
    printer_head(t);
}

// The longest lists are cut to the results that have not converged, then the first ones.
static bool is_shown(const struct refined *f, int *n_shown) {
    bool shown = f->owner == OF_MODEL || f->index < SHOWN_MAX || (!f->within && *n_shown > 0);
    *n_shown -= !f->within && f->index >= SHOWN_MAX && shown;
    return shown;
}

static int print_results(const struct model *m, const struct refinement *r) {
    struct printer t = {.to = stdout, .indent = 2};
    int left = SHOWN_MAX, n_hidden = 0;
    const struct refined *before = NULL;
    print_heading(&t, r, m);
    for (int i = 0; i < r->n_result; i++) {
        const struct refined *f = &r->result[i];
        if (!is_shown(f, &left)) {
            n_hidden++;
            continue;
        }
        if (f->owner != OF_MODEL &&
            (!before || before->owner != f->owner || before->index != f->index)) {
            safe_line(stdout, "%s %s", owner_of(m, f), name_of(m, f));
        }
        // The result. An acceleration has a second row, in g.
        char unit[48];
        print_row(&t, r, f, f->dimension ? unit_of(m, f, unit, sizeof unit) : "", 1.0);
        if (f->dimension && dimension_equal(*f->dimension, dimension_acceleration)) {
            const struct unit_system *u = &m->deck->units;
            print_row(&t, r, f, "g", u->gravity / unit_size(u, dimension_acceleration));
        }
        before = f;
    }
    if (n_hidden > 0) {
        printf("  %d more results not shown; --tsv prints all\n", n_hidden);
    }
    return printer_close(&t);
}

static void print_verdict(const struct model *m, const struct refinement *r, double rtol) {
    int left = SHOWN_MAX;
    printf("\n%d of %d results have converged to %g\n", r->n_within, r->n_result, rtol);
    for (int i = 0; i < r->n_result && left > 0; i++) {
        const struct refined *f = &r->result[i];
        if (f->within) {
            continue;
        }
        const double more = halvings(f, f->value[r->n_level - 1], rtol);
        printf("  ");
        if (f->owner != OF_MODEL) {
            printf("%s %s ", owner_of(m, f), name_of(m, f));
        }
        printf("%s: %s", f->quantity, reason_of(f));
        if (more > 0.0 && r->n_level + more <= CONVERGENCE_LEVELS_MAX) {
            printf("; %.0f more level%s should do", more, more == 1.0 ? "" : "s");
        }
        printf("\n");
        left--;
    }
    int n_more = r->n_result - r->n_within - (SHOWN_MAX - left);
    if (n_more > 0) {
        printf("  and %d more\n", n_more);
    }
}

static int print_data(const struct model *m, const struct refinement *r, enum printer_form form) {
    struct printer t = {.to = stdout, .form = form};
    char key[CONVERGENCE_LEVELS_MAX][32], unit[48];
    PRINTER_ADD(&t, of_result);
    for (int i = 0; i < r->n_level; i++) {
        snprintf(key[i], sizeof key[i], "%s_%.9g", m->adaptive ? "tolerance" : "step", r->step[i]);
        printer_add(&t, &(struct printer_column)COLUMN_DATA(key[i]), 1);
    }
    PRINTER_ADD(&t, of_convergence);
    printer_head(&t);
    for (int i = 0; i < r->n_result; i++) {
        const struct refined *f = &r->result[i];
        const struct convergence *c = &f->convergence;
        printer_text(&t, owner_of(m, f));
        printer_text(&t, name_of(m, f));
        printer_text(&t, f->quantity);
        printer_text(&t, unit_of(m, f, unit, sizeof unit));
        printer_numbers(&t, f->value, r->n_level);
        printer_numbers(&t, (const double[]){c->order, c->estimate, c->error}, 3);
        printer_whole(&t, f->within);
        printer_text(&t, reason_of(f));
        printer_line(&t);
    }
    return printer_close(&t);
}

static int print(const struct model *m, const struct refinement *r, double rtol,
                 enum printer_form form) {
    if (form != FORM_TEXT) {
        return print_data(m, r, form);
    }
    const int status = print_results(m, r);
    print_verdict(m, r, rtol);
    return status;
}

static int show_progress(void *context, double time, struct error *e) {
    (void)e;
    progress_show(context, time);
    return STATUS_OK;
}

static int converge(void *options, const struct model *m) {
    const struct options *o = options;
    struct progress progress;
    struct refinement *r;
    struct error e;
    const struct observer observer = {.poll = show_progress, .context = &progress};
    progress_start(&progress, m->duration, m->deck->units.time_name);
    int status = refinement_run(m, o->n_level, o->rtol, &observer, &r, &e);
    progress_end(&progress);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    status = print(m, r, o->rtol, o->form);
    if (status == EXIT_DONE && r->n_within < r->n_result) {
        status = EXIT_FAILED;
    }
    refinement_free(r);
    return status;
}

static int converge_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        DECK_DEFINE_ROW,
        {"levels", 'n', "LEVELS", OPTION_WHOLE, OPTION_LETTER_ONLY, AT(n_level),
         CONVERGENCE_LEVELS_MIN, CONVERGENCE_LEVELS_MAX,
         .doc = "number of runs, each with half the step of the one before; 3 to 16, default: 4"},
        {"rtol", 0, "R", OPTION_NUMBER, 0, AT(rtol), 1e-12, 1.0,
         .doc = "limit of the error bar for convergence, relative to the result; default: 1e-3"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "a table separated by tabs, with the results of all levels"},
        {0}};
    static const struct option_part parts[] = {
        {.row = rows},
        {.row = printer_rows, .at = AT(form)},
        {.row = option_help},
        {.text = "\nThe command writes no file. Exit status 0: all results have converged; 1: some "
                 "have not.\n"},
        {0}};
    static const struct deck_command c = {&command_converge, parts, .use = converge};
    struct options o = {.n_level = LEVELS_DEFAULT, .rtol = RTOL_DEFAULT};
    return deck_command_run(&c, argc, argv, &o.load);
}
