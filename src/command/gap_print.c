// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/gap_print.h"

#include <math.h>
#include <stdio.h>

#include "command/cells.h"
#include "command/study_print.h"
#include "core/safe.h"
#include "core/text.h"

enum { NAME_WIDTH = 14 };

static void print_number(double x, int width) {
    if (isnan(x)) {
        printf(" %*s", width, "-");
    } else {
        printf(" %*.4g", width, x);
    }
}

static void print_ratio(double x) {
    if (isnan(x)) {
        printf(" %6s", "-");
    } else {
        printf(" %6.3f", x);
    }
}

static void print_closings(const struct plan *p, const struct apart *a, double *scratch) {
    printf("%-*s %9s %9s %9s %9s %9s %6s %9s %9s\n", NAME_WIDTH, "closing by", "mean", "16 %",
           "50 %", "84 %", "largest", "in run", "gap", "runs hit");
    for (int i = 0; i < a->n_contact; i++) {
        const struct apart_summary s = apart_summarise(a, i, APART_CLOSING, APART_VALUES, scratch);
        const double gap = apart_summarise(a, i, APART_GAP, APART_VALUES, scratch).mean;
        safe_cell(stdout, p->first->link[i].name, NAME_WIDTH);
        const double value[] = {s.mean, s.low, s.median, s.high, s.largest};
        for (int k = 0; k < 5; k++) {
            print_number(value[k], 9);
        }
        printf(" %6ld", s.run + 1);
        print_number(gap, 9);
        printf(" %9ld\n", apart_hits(a, i));
    }
}

// Means over the runs: what goes into the rules, and what comes out.
static void print_rules(const struct plan *p, const struct apart *a, double *scratch) {
    printf("\n%-*s %9s %9s %7s", NAME_WIDTH, "rules", "uA", "uB", "rho");
    for (int k = 0; k < SEPARATION_RULES; k++) {
        printf(" %13s", separation_rules[k].name);
    }
    printf("\n");
    for (int i = 0; i < a->n_contact; i++) {
        static const int input[] = {APART_LEFT, APART_RIGHT, APART_RHO};
        safe_cell(stdout, p->first->link[i].name, NAME_WIDTH);
        for (int k = 0; k < 3; k++) {
            print_number(apart_summarise(a, i, input[k], APART_VALUES, scratch).mean,
                         k < 2 ? 9 : 7);
        }
        for (int k = 0; k < SEPARATION_RULES; k++) {
            print_number(apart_summarise(a, i, APART_RULE + k, APART_VALUES, scratch).mean, 13);
        }
        printf("\n");
    }
}

// How far the rules are off, run by run: mean and least of their ratio to the closing displacement.
static void print_ratios(const struct plan *p, const struct apart *a, double *scratch) {
    printf("\n%-*s %9s %9s %7s", NAME_WIDTH, "of the closing", "", "", "");
    for (int k = 0; k < SEPARATION_RULES; k++) {
        printf(" %13s", "mean  least");
    }
    printf("\n");
    for (int i = 0; i < a->n_contact; i++) {
        safe_cell(stdout, p->first->link[i].name, NAME_WIDTH);
        printf(" %9s %9s %7s", "", "", "");
        for (int k = 0; k < SEPARATION_RULES; k++) {
            const struct apart_summary s =
                apart_summarise(a, i, APART_RULE + k, APART_CLOSING, scratch);
            print_ratio(s.mean);
            print_ratio(s.least);
        }
        printf("\n");
    }
}

static void print_modes(const struct plan *p, const struct apart *a, double *scratch) {
    const struct model *m = p->first;
    printf("\n%-*s %9s %9s\n", NAME_WIDTH, "first modes", "T", "damp. [%]");
    for (int building = 0; building < m->n_building; building++) {
        int contact = -1, side = 0;
        for (int i = 0; i < a->n_contact; i++) {
            for (int k = 0; k < 2; k++) {
                if (m->link[i].building[k] == building) {
                    contact = i;
                    side = k;
                }
            }
        }
        if (contact < 0) {
            continue;
        }
        safe_cell(stdout, m->building[building].name, NAME_WIDTH);
        print_number(
            apart_summarise(a, contact, APART_PERIOD_LEFT + side, APART_VALUES, scratch).mean, 9);
        print_number(
            100.0 *
                apart_summarise(a, contact, APART_DAMPING_LEFT + side, APART_VALUES, scratch).mean,
            9);
        printf("\n");
    }
}

static void print_head(const struct plan *p, const struct apart *a) {
    const struct deck *d = p->first->deck;
    printf("%s%s%ld run%s without contact, %ld failed; lengths in %s, times in %s\n", d->title,
           d->title[0] ? "\n" : "", a->n_run, a->n_run == 1 ? "" : "s", a->n_failed,
           d->units.length_name, d->units.time_name);
    int k = 0;
    for (const struct sweep *s = d->sweeps; s; s = s->next, k++) {
        struct text_short t;
        if (a->idle[k]) {
            printf("the values of %s make no difference and count once\n", text_short(&t, s->name));
        }
    }
    printf("\n");
}

void gap_print_apart(const struct plan *p, const struct apart *a, double *scratch) {
    print_head(p, a);
    print_closings(p, a, scratch);
    print_rules(p, a, scratch);
    print_ratios(p, a, scratch);
    print_modes(p, a, scratch);
    printf("\nclosing by: largest x_A - x_B at the floors of the contact, A the left one\n"
           "uA, uB: largest displacements of these floors; the rules are applied run by run\n");
    for (int k = 0; k < SEPARATION_RULES; k++) {
        printf("%-12s = %s\n    %s\n", separation_rules[k].name, separation_rules[k].formula,
               separation_rules[k].source);
    }
}

// A column for each sweep and each one along it.
static void print_sweep_names(const struct plan *p) {
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next) {
        for (const struct sweep *along = s; along; along = along->along) {
            printf("\t%s", along->name);
        }
    }
}

static void print_sweep_values(const struct plan *p, long run, struct cells *c) {
    int choice[STUDY_SWEEPS_MAX];
    int i = 0;
    plan_choose(p, run, choice);
    for (const struct sweep *s = p->first->deck->sweeps; s; s = s->next, i++) {
        for (const struct sweep *along = s; along; along = along->along) {
            if (along->number) {
                cells_number(c, along->number[choice[i]]);
            } else {
                cells_text(c, along->label[choice[i]]);
            }
        }
    }
}

static void print_heads(const struct plan *p) {
    const struct unit_system *u = &p->first->deck->units;
    printf("run");
    print_sweep_names(p);
    printf("\tstatus\tcontact\tgap [%s]\tclosing [%s]\tu_left [%s]\tu_right [%s]", u->length_name,
           u->length_name, u->length_name, u->length_name);
    printf("\tT_left [%s]\tT_right [%s]\tdamping_left\tdamping_right\trho", u->time_name,
           u->time_name);
    for (int k = 0; k < SEPARATION_RULES; k++) {
        printf("\t%s [%s]", separation_rules[k].key, u->length_name);
    }
    printf("\tmessage\n");
}

void gap_print_apart_tsv(const struct plan *p, const struct apart *a) {
    struct cells c = {.to = stdout, .form = CELLS_TSV};
    print_heads(p);
    for (long run = 0; run < a->n_run; run++) {
        const struct study_outcome *outcome = &a->outcome[run];
        for (int i = 0; i < a->n_contact; i++) {
            const double *value = apart_values(a, run, i);
            cells_whole(&c, run + 1);
            print_sweep_values(p, run, &c);
            cells_text(&c, study_print_status(outcome));
            cells_text(&c, p->first->link[i].name);
            cells_numbers(&c, value, APART_VALUES);
            cells_text(&c, outcome->message);
            cells_end(&c);
        }
    }
}
