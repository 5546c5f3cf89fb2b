// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/gap_print.h"

#include <math.h>
#include <stdio.h>

#include "command/study_print.h"
#include "core/safe.h"
#include "core/text.h"

static const struct printer_column closings[] = {
    COLUMN_NAME("closing by", 14), COLUMN_G("mean", 9, 4), COLUMN_G("16 %", 9, 4),
    COLUMN_G("50 %", 9, 4),        COLUMN_G("84 %", 9, 4), COLUMN_G("largest", 9, 4),
    COLUMN_TEXT("in run", 6),      COLUMN_G("gap", 9, 4),  COLUMN_TEXT("runs hit", 9)};
static const struct printer_column inputs[] = {COLUMN_NAME("rules", 14), COLUMN_G("uA", 9, 4),
                                               COLUMN_G("uB", 9, 4), COLUMN_G("rho", 7, 4)};
static const struct printer_column closing[] = {COLUMN_NAME("of the closing", 14),
                                                COLUMN_TEXT("", 27)};
static const struct printer_column levels[] = {COLUMN_NAME("by height", 14), COLUMN_G("hA", 7, 4),
                                               COLUMN_G("hB", 7, 4), COLUMN_G("HA", 7, 4),
                                               COLUMN_G("HB", 7, 4)};
static const struct printer_column ratio[] = {COLUMN_F("mean", 6, 3), COLUMN_F("least", 6, 3)};
static const struct printer_column modes[] = {COLUMN_NAME("first modes", 14), COLUMN_G("T", 9, 4),
                                              COLUMN_G("damp. [%]", 9, 4)};
// Behind the sweeps, before the rules; the values in the order of enum contact_free_value.
static const struct printer_column of_contact[] = {COLUMN_DATA("status"),
                                                   COLUMN_DATA("contact"),
                                                   COLUMN_OF("gap", dimension_length),
                                                   COLUMN_OF("closing", dimension_length),
                                                   COLUMN_OF("u_left", dimension_length),
                                                   COLUMN_OF("u_right", dimension_length),
                                                   COLUMN_OF("T_left", dimension_time),
                                                   COLUMN_OF("T_right", dimension_time),
                                                   COLUMN_DATA("damping_left"),
                                                   COLUMN_DATA("damping_right"),
                                                   COLUMN_DATA("rho"),
                                                   COLUMN_OF("level_left", dimension_length),
                                                   COLUMN_OF("level_right", dimension_length),
                                                   COLUMN_OF("height_left", dimension_length),
                                                   COLUMN_OF("height_right", dimension_length)};

// What the tables are about.
struct view {
    const struct plan *p;
    const struct contact_free *a;
    double *scratch;  // (n_run)
    bool shown[SEPARATION_RULES];
};

static double mean(const struct view *v, int contact, int value) {
    return contact_free_summarise(v->a, contact, value, FREE_VALUES, v->scratch).mean;
}

static void print_closing(struct printer *t, const struct view *v, int i) {
    const struct contact_free_summary s =
        contact_free_summarise(v->a, i, FREE_CLOSING, FREE_VALUES, v->scratch);
    printer_numbers(t, (const double[]){s.mean, s.low, s.median, s.high, s.largest}, 5);
    printer_whole(t, s.run + 1);
    printer_number(t, mean(v, i, FREE_GAP));
    printer_whole(t, contact_free_hits(v->a, i));
}

static double mean_ratio(const struct view *v, int contact, int rule, double *least) {
    const struct contact_free_summary s =
        contact_free_summarise(v->a, contact, FREE_RULE + rule, FREE_CLOSING, v->scratch);
    *least = s.least;
    return s.mean;
}

// Means over the runs: what goes into the rules, and what comes out.
static void print_rules(struct printer *t, const struct view *v, int i) {
    printer_number(t, mean(v, i, FREE_LEFT));
    printer_number(t, mean(v, i, FREE_RIGHT));
    printer_number(t, mean(v, i, FREE_RHO));
    for (int k = 0; k < SEPARATION_GENERAL; k++) {
        printer_number(t, mean(v, i, FREE_RULE + k));
    }
}

// How far the rules are off, run by run: mean and least of their ratio to the closing displacement.
static void print_ratios(struct printer *t, const struct view *v, int i) {
    printer_empty(t);
    for (int k = 0; k < SEPARATION_GENERAL; k++) {
        double least;
        printer_number(t, mean_ratio(v, i, k, &least));
        printer_number(t, least);
    }
}

// Rules that depend on heights, and their ratios. A wall has no height.
static void print_by_height(struct printer *t, const struct view *v, int i) {
    for (int k = FREE_LEVEL_LEFT; k <= FREE_HEIGHT_RIGHT; k++) {
        const double value = mean(v, i, k);
        printer_number(t, isinf(value) ? (double)NAN : value);
    }
    for (int k = SEPARATION_GENERAL; k < SEPARATION_RULES; k++) {
        if (v->shown[k]) {
            double least;
            printer_number(t, mean(v, i, FREE_RULE + k));
            printer_number(t, mean_ratio(v, i, k, &least));
            printer_number(t, least);
        }
    }
}

static int print_contacts(struct printer *t, const struct view *v,
                          void line(struct printer *t, const struct view *v, int contact)) {
    printer_head(t);
    for (int i = 0; i < v->a->n_contact; i++) {
        printer_text(t, v->p->first->link[i].name);
        line(t, v, i);
        printer_line(t);
    }
    fputc('\n', t->to);
    return printer_close(t);
}

static int print_modes(const struct view *v) {
    const struct model *m = v->p->first;
    struct printer t = {.to = stdout};
    PRINTER_ADD(&t, modes);
    printer_head(&t);
    for (int building = 0; building < m->n_building; building++) {
        int at = -1;  // twice the last contact of the building, and its side there
        for (int i = 0; i < 2 * v->a->n_contact; i++) {
            at = m->link[i / 2].building[i % 2] == building ? i : at;
        }
        if (at >= 0) {
            printer_text(&t, m->building[building].name);
            printer_number(&t, mean(v, at / 2, FREE_PERIOD_LEFT + at % 2));
            printer_number(&t, 100.0 * mean(v, at / 2, FREE_DAMPING_LEFT + at % 2));
            printer_line(&t);
        }
    }
    return printer_close(&t);
}

static void print_head(const struct plan *p, const struct contact_free *a) {
    const struct deck *d = p->first->deck;
    if (d->title[0]) {
        safe_line(stdout, "%s", d->title);
    }
    printf("%ld run%s without contact, %ld failed; lengths in %s, times in %s\n", a->n_run,
           a->n_run == 1 ? "" : "s", a->n_failed, d->units.length_name, d->units.time_name);
    int k = 0;
    for (const struct sweep *s = d->sweeps; s; s = s->next, k++) {
        struct text_short t;
        if (a->idle[k]) {
            printf("the values of %s make no difference and count once\n", text_short(&t, s->name));
        }
    }
    printf("\n");
}

// The formulas that were shown, with their sources, and what they take from the user.
static void print_sources(const struct view *v, const struct separation_site *site) {
    const struct model *m = v->p->first;
    printf("\nclosing by: largest x_A - x_B at the floors of the contact, A the left one\n"
           "uA, uB: largest displacements of these floors; the rules are applied run by run\n");
    for (int i = 0; i < m->n_building; i++) {
        if (site->factor[i] != 1.0) {
            safe_line(stdout, "The rules multiply the displacements of %s by %g.",
                      m->building[i].name, site->factor[i]);
        }
    }
    if (v->shown[SEPARATION_GB] || v->shown[SEPARATION_NTC]) {
        printf(
            "hA, hB: levels of the contact above the ground; HA, HB: heights of the buildings\n");
    }
    for (int k = 0; k < SEPARATION_RULES; k++) {
        if (v->shown[k]) {
            printf("%-12s = %s\n    %s\n", contact_free_rules[k].name,
                   contact_free_rules[k].formula, contact_free_rules[k].source);
        }
        if (v->shown[k] && k == SEPARATION_GB) {
            printf("    here step = %g m, share = %g\n", site->gb_step, site->gb_share);
        } else if (v->shown[k] && k == SEPARATION_NTC) {
            printf("    here slope = %g\n", site->ntc_slope);
        }
    }
}

int gap_print_contact_free(const struct plan *p, const struct contact_free *a,
                           const struct separation_site *site, double *scratch) {
    struct view v = {p, a, scratch, {true, true, true, true}};
    v.shown[SEPARATION_GB] = site->gb_step > 0.0;
    v.shown[SEPARATION_NTC] = !isnan(site->ntc_slope);
    struct printer t[4] = {{.to = stdout}, {.to = stdout}, {.to = stdout}, {.to = stdout}};
    PRINTER_ADD(&t[0], closings);
    PRINTER_ADD(&t[1], inputs);
    PRINTER_ADD(&t[2], closing);
    PRINTER_ADD(&t[3], levels);
    for (int k = 0; k < SEPARATION_RULES; k++) {
        const bool general = k < SEPARATION_GENERAL;
        const struct printer_column name =
            COLUMN_G(contact_free_rules[k].name, general ? 13 : 10, 4);
        if (v.shown[k]) {
            printer_add(&t[general ? 1 : 3], &name, 1);
            PRINTER_ADD(&t[general ? 2 : 3], ratio);
        }
    }
    print_head(p, a);
    int status = print_contacts(&t[0], &v, print_closing) | print_contacts(&t[1], &v, print_rules) |
                 print_contacts(&t[2], &v, print_ratios);
    if (v.shown[SEPARATION_GB] || v.shown[SEPARATION_NTC]) {
        status |= print_contacts(&t[3], &v, print_by_height);
    } else {
        status |= printer_close(&t[3]);
    }
    status |= print_modes(&v);
    print_sources(&v, site);
    return status;
}

int gap_print_runs(const struct plan *p, const struct contact_free *a, enum printer_form form) {
    const struct deck *d = p->first->deck;
    struct printer t = {.to = stdout, .form = form, .units = &d->units};
    printer_add(&t, &(struct printer_column)COLUMN_DATA("run"), 1);
    for (const struct sweep *s = d->sweeps; s; s = s->next) {
        printer_add_sweep(&t, s);
    }
    PRINTER_ADD(&t, of_contact);
    for (int k = 0; k < SEPARATION_RULES; k++) {
        const char *key = contact_free_rules[k].key;
        printer_add(&t, &(struct printer_column)COLUMN_OF(key, dimension_length), 1);
    }
    printer_add(&t, &(struct printer_column)COLUMN_DATA("message"), 1);
    printer_head(&t);
    for (long i = 0; i < a->n_run * a->n_contact; i++) {
        const long run = i / a->n_contact;
        const int contact = (int)(i % a->n_contact);
        int choice[STUDY_SWEEPS_MAX], k = 0;
        plan_choose(p, run, choice);
        printer_whole(&t, run + 1);
        for (const struct sweep *s = d->sweeps; s; s = s->next) {
            printer_sweep(&t, s, choice[k++]);
        }
        printer_text(&t, study_print_status(&a->outcome[run]));
        printer_text(&t, p->first->link[contact].name);
        printer_numbers(&t, contact_free_values(a, run, contact), FREE_VALUES);
        printer_text(&t, a->outcome[run].message);
        printer_line(&t);
    }
    return printer_close(&t);
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

static void print_point(struct printer *t, const struct gap_search_request *q,
                        const struct gap_point *p) {
    static const char *const stage[] = {
        [GAP_SCAN] = "scan", [GAP_BISECTION] = "bisection", [GAP_OPEN] = "no contact"};
    const bool text = t->form == FORM_TEXT;
    char note[STUDY_MESSAGE_MAX + 40] = "";
    if (p->n_failed > 0) {
        snprintf(note, sizeof note, "%ld failed: %s", p->n_failed, p->message);
    } else if (p->n_collapsed > 0) {
        snprintf(note, sizeof note, "%ld collapsed", p->n_collapsed);
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
           (q->to - q->from) / (q->n - 1), length);
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
