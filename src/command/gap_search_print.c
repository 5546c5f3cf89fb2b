// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>
#include <stdio.h>

#include "command/gap_print.h"
#include "command/study_print.h"
#include "core/safe.h"

static double spacing(const struct gap_search_request *q) {
    return (q->to - q->from) / (q->n - 1);
}

// "largest drift at most 0.02 m, percentile 84 of 40 runs"
static void print_aim(const struct gap_search_request *q, const struct gap_search *s) {
    const struct deck *d = q->plan->first->deck;
    const bool counts = dimension_equal(q->edp.dimension, dimension_none);
    char runs[80] = "";
    if (d->title[0]) {
        safe_line(stdout, "%s", d->title);
    }
    if (s->n_run > 1 && q->percentile == 100.0) {
        snprintf(runs, sizeof runs, " in all %ld runs", s->n_run);
    } else if (s->n_run > 1) {
        snprintf(runs, sizeof runs, ", percentile %g of %ld runs", q->percentile, s->n_run);
    }
    safe_line(stdout, "%s%s at most %.6g%s%s%s%s",
              q->edp.quantity->reduction != EDP_SUM ? "largest " : "", q->edp.text, q->limit,
              counts ? "" : " ", counts ? "" : q->edp.units,
              study_print_g(&d->units, q->edp.units, q->limit).added, runs);
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

static void print_point(struct printer *t, const struct gap_search_request *q,
                        const struct gap_point *p) {
    static const char *const stage[] = {
        [GAP_SCAN] = "scan", [GAP_BISECTION] = "bisection", [GAP_OPEN] = "no contact"};
    const bool text = t->form == FORM_TEXT;
    char note[STUDY_MESSAGE_MAX + 40] = "";
    if (p->n_failed > 0) {
        snprintf(note, sizeof note, "%ld failed: %s", p->n_failed, p->message);
    }
    printer_text(t, stage[p->stage]);
    if (text && p->stage == GAP_OPEN) {
        printer_text(t, "no contact");
    } else {
        printer_number(t, p->gap);
    }
    const double value = text && p->n_failed > 0 ? (double)NAN : p->value;
    printer_number(t, value);
    printer_text(t, isnan(value) ? "" : study_print_g(t->units, q->edp.units, value).text);
    printer_text(t, text ? (p->kept ? "met" : "exceeded") : (p->kept ? "kept" : "broken"));
    printer_whole(t, p->n_failed);
    printer_whole(t, p->run + 1);
    printer_text(t, text ? note : p->message);
    printer_line(t);
}

static void print_points(struct printer *t, const struct gap_search_request *q,
                         const struct gap_search *s) {
    const bool text = t->form == FORM_TEXT;
    printer_head(t);
    for (int i = 0; i < s->n_point; i++) {
        if (!text || s->point[i].stage == GAP_SCAN) {
            print_point(t, q, &s->point[i]);
        }
    }
    if (s->opened) {
        print_point(t, q, &s->open);
    }
    if (!text && s->found) {
        printer_text(t, "result");
        printer_number(t, s->gap);
        printer_empty(t);
        printer_empty(t);
        printer_text(t, "kept");
        printer_line(t);
    }
}

int gap_print_search(const struct gap_search_request *q, const struct gap_search *s,
                     enum printer_form form) {
    const struct unit_system *u = &q->plan->first->deck->units;
    const bool counts = dimension_equal(q->edp.dimension, dimension_none);
    const bool in_g = study_print_g(u, q->edp.units, q->limit).text[0];
    const struct printer_column columns[] = {COLUMN_DATA("stage"),
                                             {"gap", "gap", NULL, &dimension_length, 12, 5, LOOK_G},
                                             {"value", q->edp.text,
                                              form == FORM_TEXT && counts ? "" : q->edp.units, NULL,
                                              14, 6, LOOK_G},
                                             {.head = in_g ? "[g]" : NULL, .width = 9},
                                             {.head = "limit", .key = "limit", .width = 8},
                                             COLUMN_DATA("failed"),
                                             {.head = "in run", .key = "run", .width = 8},
                                             {.head = "", .key = "message"}};
    struct printer t = {.to = stdout, .form = form, .units = u};
    PRINTER_ADD(&t, columns);
    if (form == FORM_TEXT) {
        print_aim(q, s);
        printf("%s%s: %d gaps from %.6g to %.6g %s, then bisection to %.3g %s, %d gaps in all\n\n",
               q->parameter ? "parameter " : "",
               q->parameter ? q->parameter : "gaps of all contacts", q->n, q->from, q->to,
               u->length_name, q->tolerance, u->length_name, s->n_point);
    }
    print_points(&t, q, s);
    if (form == FORM_TEXT) {
        print_answer(q, s);
    }
    return printer_close(&t);
}
