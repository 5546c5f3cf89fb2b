// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/converge_print.h"

#include <math.h>
#include <stdio.h>

#include "command/cells.h"
#include "command/sweeps.h"

enum { SHOWN_MAX = 20, LABEL_WIDTH = 23, SHOWN_LEVELS = 3 };

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

static void print_result(const struct model *m, const struct refinement *r,
                         const struct refined *f) {
    char unit[48], label[96];
    const double *last = f->value + r->n_level - 1;
    snprintf(label, sizeof label, "%s%s%s%s", f->quantity, f->dimension ? " [" : "",
             f->dimension ? unit_of(m, f, unit, sizeof unit) : "", f->dimension ? "]" : "");
    printf("  %-*s", LABEL_WIDTH, label);
    for (int i = 1 - SHOWN_LEVELS; i <= 0; i++) {
        printf(" %11.6g", last[i]);
    }
    if (isnan(f->convergence.order)) {
        printf("     -");
    } else {
        printf(" %5.2f", f->convergence.order);
    }
    printf(" %11.6g %9.1e  %s\n", f->convergence.estimate,
           f->convergence.error != 0.0 ? f->convergence.error / fabs(*last) : 0.0,
           f->within ? "yes" : "no");
}

static void print_heading(const struct refinement *r, const struct model *m) {
    const char *unit = m->adaptive ? " " : m->deck->units.time_name;
    printf("%s%s", m->deck->title, m->deck->title[0] ? "\n" : "");
    sweeps_print_first(m->deck, "", "");
    printf("%d levels, %s", r->n_level, m->adaptive ? "tolerances" : "steps");
    for (int i = 0; i < r->n_level; i++) {
        printf(" %.6g", r->step[i]);
    }
    printf(" %s\n\n  %-*s", unit, LABEL_WIDTH, m->adaptive ? "at a tolerance of" : "at a step of");
    for (int i = r->n_level - SHOWN_LEVELS; i < r->n_level; i++) {
        printf(" %9.4g %s", r->step[i], unit);
    }
    printf(" order    estimate error bar  converged\n");
}

// The longest lists are cut to the results that have not converged, then the first ones.
static bool is_shown(const struct refined *f, int *n_shown) {
    bool shown = f->owner == OF_MODEL || f->index < SHOWN_MAX || (!f->within && *n_shown > 0);
    *n_shown -= !f->within && f->index >= SHOWN_MAX && shown;
    return shown;
}

static void print_results(const struct model *m, const struct refinement *r) {
    int left = SHOWN_MAX, n_hidden = 0;
    const struct refined *before = NULL;
    print_heading(r, m);
    for (int i = 0; i < r->n_result; i++) {
        const struct refined *f = &r->result[i];
        if (!is_shown(f, &left)) {
            n_hidden++;
            continue;
        }
        if (f->owner != OF_MODEL &&
            (!before || before->owner != f->owner || before->index != f->index)) {
            printf("%s %s\n", owner_of(m, f), name_of(m, f));
        }
        print_result(m, r, f);
        before = f;
    }
    if (n_hidden > 0) {
        printf("  %d more results not shown; --tsv prints all\n", n_hidden);
    }
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

void converge_print_tsv(const struct model *m, const struct refinement *r) {
    struct cells c = {.to = stdout, .form = CELLS_TSV};
    char unit[48];
    printf("owner\tname\tquantity\tunit");
    for (int i = 0; i < r->n_level; i++) {
        printf("\t%s_%.9g", m->adaptive ? "tolerance" : "step", r->step[i]);
    }
    printf("\torder\testimate\terror\tconverged\treason\n");
    for (int i = 0; i < r->n_result; i++) {
        const struct refined *f = &r->result[i];
        cells_text(&c, owner_of(m, f));
        cells_text(&c, name_of(m, f));
        cells_text(&c, f->quantity);
        cells_text(&c, unit_of(m, f, unit, sizeof unit));
        cells_numbers(&c, f->value, r->n_level);
        cells_number(&c, f->convergence.order);
        cells_number(&c, f->convergence.estimate);
        cells_number(&c, f->convergence.error);
        cells_whole(&c, f->within);
        cells_text(&c, reason_of(f));
        cells_end(&c);
    }
}

void converge_print(const struct model *m, const struct refinement *r, double rtol) {
    print_results(m, r);
    print_verdict(m, r, rtol);
}
