// SPDX-License-Identifier: GPL-3.0-or-later
// jostle sensitivity: how much each random parameter of a deck matters for a demand.
#include "study/sensitivity.h"

#include <math.h>

#include "command/deck_command.h"
#include "command/printer.h"
#include "command/progress.h"
#include "command/suite_options.h"
#include "core/arena.h"
#include "core/quantity.h"
#include "core/safe.h"

static int sensitivity_command(int argc, char **argv);

const struct command command_sensitivity = {
    .name = "sensitivity",
    .usage = "DECK --edp EDP [--share Q] [--morris R [--levels P]|--variance [--samples N]]\n"
             "                          [-D NAME=VALUE]... [-j THREADS] [--tsv|--csv|--json]",
    .summary = "ranks the random parameters of a deck by what they do to a demand",
    .run = sensitivity_command,
};

static const char explanation[] =
    "\nThe parameters are the random sweeps of the deck, which must not be correlated. Each "
    "combination of the\nother sweeps has lines of its own. By default one parameter at a time "
    "changes, in two runs, and the\nothers stay at their medians. The command writes no file. Exit "
    "status 1: runs have failed or have no\nfinite demand.\n"
    "\n--morris finds the parameters that matter at all, in R (d + 1) runs for d parameters "
    "(Morris "
    "1991). An\nelementary effect is the change of the demand over that of the probability. mu* is "
    "the mean of the\nabsolute effects, mu their mean and sigma their standard deviation "
    "(Campolongo "
    "et al. 2007). A large\nsigma: the parameter acts together with others, or not linearly.\n"
    "\n--variance makes (d + 2) N runs. first is the share of the variance that is due to the "
    "parameter alone;\ntotal also contains what it does together with others (Saltelli et al. "
    "2010). effect and scatter are\nmu* and sigma of the same runs (Campolongo et al. 2011).\n"
    "\nlow and high are the ends of an interval of 95 % confidence, by bootstrap.\n";

struct options {
    struct load_request load;
    int n_thread;
    enum printer_form form;
    int variance;
    int n_trajectory, n_level, n_sample;
    const char *edp, *share;
};
#define AT(member) offsetof(struct options, member)

// Defaults: the share one at a time, and the levels of Morris, between the middles of equal strata.
static const double SHARE = 0.1;
enum { LEVELS = 4 };

// What is printed.
struct page {
    const struct sensitivity_request *request;
    const struct sensitivity *found;
    struct printer table;
};

static void add_columns(struct page *p) {
    const char *of = unit_suffix(p->request->edp.units);
    const struct printer_column swing[] = {
        {.head = "low", .key = "low", .width = 12, .digits = 6},
        {.head = "high", .key = "high", .width = 12, .digits = 6},
        {.head = "at low", .key = "at_low", .unit = of, .width = 14, .digits = 5},
        {.head = "at high", .key = "at_high", .unit = of, .width = 14, .digits = 5},
        {.head = "at medians", .key = "at_medians", .unit = of, .width = 14, .digits = 5},
        COLUMN_DATA("edp")};
    const struct printer_column effect[] = {
        {.head = "mu*", .key = "mu_star", .unit = of, .width = 13, .digits = 5},
        {.head = "low", .key = "mu_star_low", .unit = of, .width = 13, .digits = 5},
        {.head = "high", .key = "mu_star_high", .unit = of, .width = 13, .digits = 5},
        {.head = "mu", .key = "mu", .unit = of, .width = 13, .digits = 5},
        {.head = "sigma", .key = "sigma", .unit = of, .width = 13, .digits = 5},
        COLUMN_DATA("left_out"),
        COLUMN_DATA("edp")};
    const struct printer_column share[] = {
        {.head = "first", .key = "first", .width = 9, .digits = 3, .look = LOOK_F},
        {.head = "low", .key = "first_low", .width = 7, .digits = 3, .look = LOOK_F},
        {.head = "high", .key = "first_high", .width = 7, .digits = 3, .look = LOOK_F},
        {.head = "total", .key = "total", .width = 9, .digits = 3, .look = LOOK_F},
        {.head = "low", .key = "total_low", .width = 7, .digits = 3, .look = LOOK_F},
        {.head = "high", .key = "total_high", .width = 7, .digits = 3, .look = LOOK_F},
        {.head = "effect", .key = "effect", .unit = of, .width = 13, .digits = 5},
        {.head = "scatter", .key = "scatter", .unit = of, .width = 13, .digits = 5},
        {.key = "mean", .unit = of},
        {.key = "deviation", .unit = of},
        COLUMN_DATA("left_out"),
        COLUMN_DATA("edp")};
    for (const struct sweep *s = p->found->others.plan.first->deck->sweeps; s; s = s->next) {
        if (!s->fixed) {
            printer_show_sweep(&p->table, s);
        }
    }
    printer_add(&p->table,
                &(struct printer_column){
                    .head = "parameter", .key = "parameter", .width = -16, .look = LOOK_TAIL},
                1);
    printer_add(
        &p->table,
        &(struct printer_column){.head = "unit", .key = "unit", .width = -9, .look = LOOK_TAIL}, 1);
    if (p->request->method == SENSITIVITY_VARIANCE) {
        PRINTER_ADD(&p->table, share);
    } else if (p->request->method == SENSITIVITY_MORRIS) {
        PRINTER_ADD(&p->table, effect);
    } else {
        PRINTER_ADD(&p->table, swing);
    }
}

static void print_index(struct printer *t, const struct sobol_index *x) {
    printer_number(t, x->value);
    printer_number(t, x->low);
    printer_number(t, x->high);
}

static void print_parameter(struct page *p, long group, int i) {
    const struct sensitivity_group *g = &p->found->group[group];
    struct printer *t = &p->table;
    int choice[STUDY_SWEEPS_MAX], n = 0;
    plan_choose(&p->found->others.plan, group, choice);
    for (const struct sweep *s = p->found->others.plan.first->deck->sweeps; s; s = s->next, n++) {
        if (!s->fixed) {
            printer_sweep(t, s, choice[n]);
        }
    }
    const struct sweep *of = p->found->parameter[i];
    char unit[64] = "";
    if (of->known) {
        unit_text(t->units, of->dimension, unit, sizeof unit);
    }
    printer_text(t, of->name);
    printer_text(t, unit_suffix(unit));
    if (p->request->method == SENSITIVITY_VARIANCE) {
        print_index(t, &g->share[i].first);
        print_index(t, &g->share[i].total);
        printer_number(t, g->share[i].effect);
        printer_number(t, g->share[i].scatter);
        printer_number(t, g->summary.mean);
        printer_number(t, g->summary.deviation);
        printer_whole(t, (long)g->n_left_out);
    } else if (p->request->method == SENSITIVITY_MORRIS) {
        print_index(t, &g->effect[i].mu_star);
        printer_number(t, g->effect[i].mu);
        printer_number(t, g->effect[i].sigma);
        printer_whole(t, (long)g->n_left_out);
    } else {
        printer_numbers(t, g->swing[i].at, 2);
        printer_numbers(t, g->swing[i].demand, 2);
        printer_number(t, g->middle);
    }
    printer_text(t, p->request->edp.text);
    printer_line(t);
}

static int print_all(struct page *p) {
    const struct sensitivity *s = p->found;
    if (p->table.form == FORM_TEXT && p->request->method == SENSITIVITY_VARIANCE) {
        safe_line(stdout, "shares of the variance of %s; %ld runs", p->request->edp.text, s->n_run);
    } else if (p->table.form == FORM_TEXT && p->request->method == SENSITIVITY_MORRIS) {
        safe_line(stdout,
                  "elementary effects on %s between the %g %% and %g %% quantiles; %ld runs",
                  p->request->edp.text, 100.0 * p->request->share,
                  100.0 * (1.0 - p->request->share), s->n_run);
    } else if (p->table.form == FORM_TEXT) {
        safe_line(stdout, "%s with one parameter at a time at its %g %% and %g %% quantiles",
                  p->request->edp.text, 100.0 * p->request->share,
                  100.0 * (1.0 - p->request->share));
    }
    add_columns(p);
    printer_head(&p->table);
    for (long g = 0; g < s->n_group; g++) {
        for (int k = 0; k < s->n_parameter; k++) {
            print_parameter(p, g, s->group[g].order[k]);
        }
    }
    return printer_close(&p->table);
}

// EXIT_DONE, or 1 after a message where runs have no number.
static int judge(const struct page *p) {
    const struct sensitivity *s = p->found;
    struct error e;
    if (s->n_failed + s->n_collapsed == 0) {
        return EXIT_DONE;
    }
    error_set(&e, STATUS_FAILED, "%ld of %ld runs failed, %ld collapsed; the first: %s",
              s->n_failed, s->n_run, s->n_collapsed, s->why);
    return command_fail(&e);
}

static int search(const struct options *o, struct sensitivity_request *q, struct arena *a) {
    struct sensitivity found;
    struct progress progress;
    struct error e;
    if (sensitivity_find(q, a, &found, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    q->poll = progress_poll;
    q->context = &progress;
    progress_start(&progress, (double)found.n_run, "runs");
    int status = sensitivity_run(q, a, &found, &e);
    progress_end(&progress);
    if (status != STATUS_OK) {
        return command_fail(&e);
    }
    const struct unit_system units = q->plan->first->deck->units;
    struct page p = {
        .request = q,
        .found = &found,
        .table = {.to = stdout, .form = o->form, .units = &units, .at_head = UNITS_BELOW}};
    status = print_all(&p);
    return status == EXIT_DONE ? judge(&p) : status;
}

static int use_plan(void *options, const struct plan *plan) {
    const struct options *o = options;
    const struct study_view view = plan_view(plan);
    const int n_level = o->n_level > 0 ? o->n_level : LEVELS;
    struct sensitivity_request q = {.plan = plan,
                                    .method = o->variance       ? SENSITIVITY_VARIANCE
                                              : o->n_trajectory ? SENSITIVITY_MORRIS
                                                                : SENSITIVITY_ONE_AT_A_TIME,
                                    .share = o->n_trajectory ? 0.5 / n_level : SHARE,
                                    .n_row = o->variance ? o->n_sample : o->n_trajectory,
                                    .n_level = n_level,
                                    .n_thread = o->n_thread};
    struct error e;
    if (deck_command_check_study(plan->first, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    if (o->share) {
        const char *end =
            quantity_word(o->share, &view.units, &dimension_none, BARE_ALLOWED, &q.share);
        if (!end || *end || !(q.share >= 0.0 && q.share < 0.5)) {
            return command_usage(&command_sensitivity,
                                 "--share takes a number >= 0 and < 0.5, not '%s'", o->share);
        }
    }
    return edp_parse(&view, o->edp, plan->table->arena, &q.edp, &e) == STATUS_OK
               ? search(o, &q, plan->table->arena)
               : command_fail(&e);
}

static int settle(void *options) {
    const struct options *o = options;
    const char *fault = !o->edp                          ? "give --edp EDP"
                        : o->variance && o->n_trajectory ? "give one of --morris and --variance"
                        : o->share && o->variance        ? "--share is not for --variance"
                        : o->n_sample && !o->variance    ? "--samples is for --variance"
                        : o->n_level && !o->n_trajectory ? "--levels is for --morris"
                        : o->n_level % 2 == 1            ? "--levels takes an even number"
                                                         : NULL;
    return fault ? command_usage(&command_sensitivity, "%s", fault) : EXIT_DONE;
}

static int sensitivity_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        DECK_DEFINE_ROW,
        DECK_THREADS_ROW(AT(n_thread), "threads, default: all cores"),
        {"edp", 0, "EDP", OPTION_TEXT, 0, AT(edp),
         .doc = "the demand, such as drift:A; jostle fragility --help lists them"},
        {"variance", .kind = OPTION_SET, .at = AT(variance), .set = 1,
         .doc = "shares of the variance, in place of one parameter at a time"},
        {"samples", 0, "N", OPTION_WHOLE, 0, AT(n_sample), 2, STUDY_RUNS_MAX,
         .doc = "points of each of its two samples; default: half the values (-n) of the sweeps"},
        {"morris", 0, "R", OPTION_WHOLE, 0, AT(n_trajectory), 2, STUDY_RUNS_MAX,
         .doc = "elementary effects of Morris, in R trajectories; 10 to 50 are usual"},
        {"levels", 0, "P", OPTION_WHOLE, 0, AT(n_level), 2, 256,
         .doc = "of each parameter in --morris, an even number; default: 4"},
        {"share", 0, "Q", OPTION_TEXT, 0, AT(share),
         .doc = "parameters stay between their quantiles Q and 1 - Q; default: 10%, of --morris "
                "1/(2 P)"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "a line for each parameter, separated by tabs"},
        {0}};
    static const struct option_part parts[] = {{.row = rows},
                                               {.row = printer_rows, .at = AT(form)},
                                               {.row = option_help},
                                               {.text = explanation},
                                               {0}};
    static const struct deck_command c = {&command_sensitivity, parts, settle,
                                          .use_plan = use_plan};
    struct options o = {.n_thread = deck_command_threads()};
    return deck_command_run(&c, argc, argv, &o.load);
}
