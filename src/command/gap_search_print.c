// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>
#include <stdio.h>

#include "command/cells.h"
#include "command/gap_print.h"
#include "command/study_print.h"

static double spacing(const struct gap_search_request *q) {
    return (q->to - q->from) / (q->n - 1);
}

// "largest drift at most 0.02 m, percentile 84 of 40 runs"
static void print_aim(const struct gap_search_request *q, const struct gap_search *s) {
    const struct deck *d = q->plan->first->deck;
    const bool counts = dimension_equal(q->edp.dimension, dimension_none);
    printf("%s%s%s%s at most %.6g%s%s%s", d->title, d->title[0] ? "\n" : "",
           q->edp.quantity->reduction != EDP_SUM ? "largest " : "", q->edp.text, q->limit,
           counts ? "" : " ", counts ? "" : q->edp.units,
           study_print_g(&d->units, q->edp.units, q->limit).added);
    if (s->n_run == 1) {
        printf("\n");
    } else if (q->percentile == 100.0) {
        printf(" in all %ld runs\n", s->n_run);
    } else {
        printf(", percentile %g of %ld runs\n", q->percentile, s->n_run);
    }
}

static void print_point(const struct gap_point *p) {
    if (p->stage == GAP_OPEN) {
        printf("%12s ", "no contact");
    } else {
        printf("%12.5g ", p->gap);
    }
    if (p->n_failed > 0) {
        printf("%14s %8s %8ld  %ld failed: %s\n", "-", "exceeded", p->run + 1, p->n_failed,
               p->message);
    } else {
        printf("%14.6g %8s %8ld\n", p->value, p->kept ? "met" : "exceeded", p->run + 1);
    }
}

static void print_answer(const struct gap_search_request *q, const struct gap_search *s) {
    const char *length = q->plan->first->deck->units.length_name;
    if (!s->found) {
        printf("\nno gap: the limit is exceeded at the widest one, %.6g %s\n", q->to, length);
    } else if (isnan(s->below)) {
        printf("\ngap %.6g %s: every gap scanned meets the limit\n", s->gap, length);
    } else {
        printf("\ngap %.6g %s: from here on every gap scanned meets the limit; %.6g %s does not\n",
               s->gap, length, s->below, length);
    }
    if (s->opened && s->open.n_failed == 0) {
        printf("Without any contact the limit is %s.\n",
               s->open.kept ? "met" : "exceeded: a gap that avoids contact does not meet it");
    }
    printf("The response is not a smooth function of the gap: between gaps that are %.3g %s apart\n"
           "the limit may be exceeded unseen.\n",
           spacing(q), length);
}

void gap_print_search(const struct gap_search_request *q, const struct gap_search *s) {
    const struct unit_system *u = &q->plan->first->deck->units;
    char gap[80], value[128];
    print_aim(q, s);
    printf("%s%s: %d gaps from %.6g to %.6g %s, then bisection to %.3g %s, %d gaps in all\n\n",
           q->parameter ? "parameter " : "", q->parameter ? q->parameter : "gaps of all contacts",
           q->n, q->from, q->to, u->length_name, q->tolerance, u->length_name, s->n_point);
    snprintf(gap, sizeof gap, "gap [%s]", u->length_name);
    const bool counts = dimension_equal(q->edp.dimension, dimension_none);
    snprintf(value, sizeof value, counts ? "value" : "value [%s]", q->edp.units);
    printf("%12s %14s %8s %8s\n", gap, value, "limit", "in run");
    for (int i = 0; i < s->n_point; i++) {
        if (s->point[i].stage == GAP_SCAN) {
            print_point(&s->point[i]);
        }
    }
    if (s->opened) {
        print_point(&s->open);
    }
    print_answer(q, s);
}

static void print_cells(struct cells *c, const struct gap_point *p) {
    static const char *const stage[] = {
        [GAP_SCAN] = "scan", [GAP_BISECTION] = "bisection", [GAP_OPEN] = "no contact"};
    cells_text(c, stage[p->stage]);
    cells_number(c, p->gap);
    cells_number(c, p->value);
    cells_text(c, p->kept ? "kept" : "broken");
    cells_whole(c, p->n_failed);
    cells_whole(c, p->run + 1);
    cells_text(c, p->message);
    cells_end(c);
}

void gap_print_search_tsv(const struct gap_search_request *q, const struct gap_search *s) {
    struct cells c = {.to = stdout, .form = CELLS_TSV};
    printf("stage\tgap [%s]\t%s [%s]\tlimit\tfailed\trun\tmessage\n",
           q->plan->first->deck->units.length_name, q->edp.text, q->edp.units);
    for (int i = 0; i < s->n_point; i++) {
        print_cells(&c, &s->point[i]);
    }
    if (s->opened) {
        print_cells(&c, &s->open);
    }
    if (s->found) {
        cells_text(&c, "result");
        cells_number(&c, s->gap);
        cells_empty(&c);
        cells_text(&c, "kept");
        for (int i = 0; i < 3; i++) {
            cells_empty(&c);  // failed, run, message
        }
        cells_end(&c);
    }
}
