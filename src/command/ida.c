// SPDX-License-Identifier: GPL-3.0-or-later
// jostle ida: the intensity at which each record first brings a demand beyond a limit, or a
// building down, by as few runs as the tolerance needs.
#include <math.h>

#include "command/deck_command.h"
#include "command/ida_print.h"
#include "command/progress.h"
#include "command/study_print.h"
#include "command/suite_options.h"
#include "core/quantity.h"

static int ida_command(int argc, char **argv);

const struct command command_ida = {
    .name = "ida",
    .usage = "DECK --limit EDP=VALUE|--collapse [--im NAME] [--over NAME] [--range FROM:TO]\n"
             "                  [--factor F|--step FIRST[:GROWTH]] [--tolerance T] [--runs N]\n"
             "                  [--curve spline|line|middle] [--bootstrap N [--seed S]]\n"
             "                  [--curves N|--points] [--hazard FILE] [-D NAME=VALUE]... [-j "
             "THREADS] [--tsv|--csv|--json]",
    .summary = "finds the intensities at which records exceed a limit",
    .run = ida_command,
};

static const char explanation[] =
    "\nThe intensity is a sweep of numbers of the deck; its other sweeps are records and groups. "
    "For "
    "each record\nthe search goes upwards until the limit is exceeded, by a factor or by steps "
    "that "
    "grow. Then it halves the\nlogarithmic interval until it is as narrow as the tolerance. Runs "
    "that "
    "are left fill the widest gaps below\n(Vamvatsikos & Cornell 2002, 2004). The demand need not "
    "grow "
    "with the intensity, so a search can miss an\nexceedance between two intensities: a smaller "
    "factor "
    "or step misses fewer. A lognormal curve is fitted to\nthe intensities found (Baker 2015). The "
    "command writes no file. Exit status 1: runs have failed, some record\nnever exceeds the "
    "limit, "
    "or the runs are too few for the tolerance.\n";

struct options {
    struct load_request load;
    int n_thread;
    enum printer_form form;
    int collapse, points, n_curve, n_run, n_bootstrap, seed;
    enum capacity_curve curve;
    const char *limit, *im, *over, *range, *factor, *step, *tolerance, *hazard;
};
#define AT(member) offsetof(struct options, member)

enum { DEMANDS_MAX = 10000 };  // of --curves

static const double FACTOR = 1.3, TOLERANCE = 0.01;  // the defaults

// EXIT_DONE, or 1 after a message where a sample has no intensity.
static int judge(const struct ida_print *p) {
    long n_failed = 0, n_never = 0, n_short = 0, first = -1;
    for (long run = 0; run < p->found->n; run++) {
        const enum fragility_crossing crossing = p->found->each[run].crossing;
        const bool is_short = ida_print_is_short(p->request, &p->found->each[run]);
        n_short += is_short;
        n_never += crossing == CROSSING_ABOVE && !is_short;
        n_failed += crossing == CROSSING_NO_RUNS;
        first = crossing == CROSSING_NO_RUNS && first < 0 ? run : first;
    }
    struct error e;
    struct plan_text t;
    if (n_failed > 0) {
        error_set(&e, STATUS_FAILED, "%ld of %ld searches failed, the first: %s: %s", n_failed,
                  p->found->n, plan_describe(&p->found->at.plan, first, &t),
                  p->found->each[first].failure);
        return command_fail(&e);
    }
    if (n_never > 0) {
        error_set(&e, STATUS_FAILED,
                  "%ld of %ld searches never exceed the limit; search further with --range",
                  n_never, p->found->n);
        return command_fail(&e);
    }
    if (n_short > 0) {
        error_set(&e, STATUS_FAILED,
                  "%ld of %ld searches have too few runs for the tolerance; give more --runs or a "
                  "larger --tolerance",
                  n_short, p->found->n);
        return command_fail(&e);
    }
    return EXIT_DONE;
}

// "FROM:TO", else the smallest and the largest value of the sweep.
static int parse_range(const struct options *o, const struct unit_system *u, const struct sweep *s,
                       struct capacity_request *q) {
    q->from = q->to = s->number[0];
    for (int i = 1; i < s->n; i++) {
        q->from = fmin(q->from, s->number[i]);
        q->to = fmax(q->to, s->number[i]);
    }
    if (o->range) {
        const char *at = quantity_word(o->range, u, &s->dimension, BARE_ALLOWED, &q->from);
        at =
            at && *at == ':' ? quantity_word(at + 1, u, &s->dimension, BARE_ALLOWED, &q->to) : NULL;
        if (!at || *at) {
            return command_usage(&command_ida, "--range takes FROM:TO, two values of %s, not '%s'",
                                 s->name, o->range);
        }
    }
    return q->from > 0.0 && q->from < q->to
               ? EXIT_DONE
               : command_usage(
                     &command_ida,
                     "%s from %g to %g is no range to search; give --range FROM:TO with 0 "
                     "< FROM < TO",
                     s->name, q->from, q->to);
}

// "FIRST:GROWTH", or FIRST alone for steps that do not grow.
static int parse_step(const struct options *o, const struct unit_system *u, const struct sweep *s,
                      struct capacity_request *q) {
    const char *at = quantity_word(o->step, u, &s->dimension, BARE_ALLOWED, &q->step);
    if (at && *at == ':') {
        at = quantity_word(at + 1, u, &s->dimension, BARE_ALLOWED, &q->growth);
    }
    return at && !*at && q->step > 0.0 && isfinite(q->step) && q->growth >= 0.0 &&
                   isfinite(q->growth)
               ? EXIT_DONE
               : command_usage(&command_ida,
                               "--step takes FIRST or FIRST:GROWTH, values of %s, not '%s'",
                               s->name, o->step);
}

static int parse_number(const struct unit_system *u, const char *option, const char *text,
                        double least, double *out) {
    const char *end = quantity_word(text, u, &dimension_none, BARE_ALLOWED, out);
    return end && !*end && *out > least && isfinite(*out)
               ? EXIT_DONE
               : command_usage(&command_ida, "%s takes a number > %g, not '%s'", option, least,
                               text);
}

static int search(const struct options *o, const struct plan *plan, const struct roles *roles,
                  const struct study_view *view, const struct hazard *hazard,
                  struct capacity_request *q) {
    struct capacities found;
    struct progress progress;
    struct error e;
    q->poll = progress_poll;
    q->context = &progress;
    const long n_sample = plan->n_run / view->sweep[roles->abscissa]->n;
    progress_start(&progress, (double)n_sample, "records");
    int status = capacity_search(q, &found, &e);
    progress_end(&progress);
    struct ida_print p = {
        .request = q,
        .found = &found,
        .view = view,
        .roles = roles,
        .hazard = o->hazard ? hazard : NULL,
        .n_bootstrap = o->n_bootstrap,
        .seed = o->seed,
        .table = {.to = stdout, .form = o->form, .units = &view->units, .at_head = UNITS_BELOW}};
    if (status == STATUS_OK) {
        status = o->points    ? ida_print_points(&p, &e)
                 : o->n_curve ? ida_print_curves(&p, o->n_curve, &e)
                              : ida_print_samples(&p, &e);
    }
    status = status == STATUS_OK ? judge(&p) : command_fail(&e);
    capacity_close(&found);
    return status;
}

static int check_plan(const struct options *o, const struct plan *plan, struct error *e) {
    if (o->collapse && !plan->first->collapse) {
        return error_set(e, STATUS_INPUT,
                         "the deck has no statement 'collapse', and without it no run collapses");
    }
    return deck_command_check_study(plan->first, e);
}

static int use_plan(void *options, const struct plan *plan) {
    const struct options *o = options;
    const struct study_view view = plan_view(plan);
    const struct suite_request wanted = {.abscissa = o->im, .over = o->over};
    struct roles roles;
    struct hazard hazard;
    struct error e;
    char unit[64] = "";
    if (check_plan(o, plan, &e) != STATUS_OK ||
        roles_find(&view, &wanted, &roles, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    const struct sweep *s = roles.along;
    if (!s->number || s->along || s->random || s != view.sweep[roles.abscissa]) {
        return command_usage(&command_ida, "--im %s: it has to be a sweep of numbers of its own",
                             s->name);
    }
    if (s->known) {
        unit_text(&view.units, s->dimension, unit, sizeof unit);
    }
    struct capacity_request q = {.plan = plan,
                                 .intensity = s->name,
                                 .unit = unit_suffix(unit),
                                 .factor = FACTOR,
                                 .tolerance = TOLERANCE,
                                 .n_run = o->n_run,
                                 .curve = o->curve,
                                 .n_thread = o->n_thread};
    int status = suite_options_edp_limit(
        &command_ida, plan, o->collapse ? EDP_COLLAPSE "=0" : o->limit, &q.edp, &q.limit);
    if (status == EXIT_DONE && o->n_curve && !(q.limit > 0.0)) {
        status = command_usage(&command_ida, "--curves needs a limit above 0");
    }
    status = status == EXIT_DONE ? parse_range(o, &view.units, s, &q) : status;
    if (status == EXIT_DONE && o->factor) {
        status = parse_number(&view.units, "--factor", o->factor, 1.0, &q.factor);
    }
    if (status == EXIT_DONE && o->step) {
        status = parse_step(o, &view.units, s, &q);
    }
    if (status == EXIT_DONE && o->tolerance) {
        status = parse_number(&view.units, "--tolerance", o->tolerance, 0.0, &q.tolerance);
    }
    if (status == EXIT_DONE && q.n_run == 0 && capacity_runs(&q) > CAPACITY_POINTS_MAX) {
        status =
            command_usage(&command_ida,
                          "more than %d runs for one record; take a larger --factor, --step or "
                          "--tolerance",
                          CAPACITY_POINTS_MAX);
    }
    const struct dimension dimension = s->known ? s->dimension : dimension_none;
    if (status == EXIT_DONE && o->hazard &&
        hazard_read(plan->table->arena, o->hazard, dimension, unit_size(&view.units, dimension),
                    &hazard, &e) != STATUS_OK) {
        status = command_fail(&e);
    }
    return status == EXIT_DONE ? search(o, plan, &roles, &view, &hazard, &q) : status;
}

static int settle(void *options) {
    const struct options *o = options;
    return !o->limit == !o->collapse
               ? command_usage(&command_ida, "give --limit EDP=VALUE or --collapse")
           : o->n_curve && (o->collapse || o->points)
               ? command_usage(&command_ida,
                               "--curves is for a demand, without --collapse and --points")
           : o->factor && o->step ? command_usage(&command_ida, "give --factor or --step, not both")
                                  : EXIT_DONE;
}

static int ida_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        DECK_DEFINE_ROW,
        DECK_THREADS_ROW(AT(n_thread), "threads, default: all cores"),
        {"limit", 0, "EDP=VALUE", OPTION_TEXT, 0, AT(limit),
         .doc = "the demand and its limit: drift-ratio:A=2%, force=2MN; default unit: that of the "
                "deck; jostle fragility --help lists the demands"},
        {"collapse", .kind = OPTION_SET, .at = AT(collapse), .set = 1,
         .doc = "collapse (statement collapse), in place of a demand and a limit"},
        {"im", 0, "NAME", OPTION_TEXT, 0, AT(im),
         .doc = "the sweep that is the intensity (default: im, sa, pga, intensity or scale)"},
        {"over", 0, "NAME", OPTION_TEXT, 0, AT(over),
         .doc = "sweeps whose values are samples, as NAME or NAME,NAME (default: record, or the "
                "only sweep of texts, and the samples of random sweeps)"},
        {"range", 0, "FROM:TO", OPTION_TEXT, 0, AT(range),
         .doc = "intensities to search; default: from the smallest to the largest of the sweep"},
        {"factor", 0, "F", OPTION_TEXT, 0, AT(factor),
         .doc = "factor from one intensity to the next of the search upwards; default: 1.3"},
        {"step", 0, "FIRST[:GROWTH]", OPTION_TEXT, 0, AT(step),
         .doc =
             "first step of the search upwards, in place of the factor, and how much longer each "
             "step is than the one before: 0.1g:0.05g"},
        {"tolerance", 0, "T", OPTION_TEXT, 0, AT(tolerance),
         .doc = "relative width of the interval that the search ends in; default: 1%"},
        {"runs", 0, "N", OPTION_WHOLE, 0, AT(n_run), 2, CAPACITY_POINTS_MAX,
         .what = "a number of runs",
         .doc =
             "makes N runs for each record: those that the tolerance leaves fill the widest gaps "
             "below the limit; default: as many as the tolerance needs"},
        {"curve", 0, "spline|line|middle", OPTION_CHOICE, 0, AT(curve),
         .doc = "where the limit is crossed between two intensities: on a natural cubic spline "
                "through all runs (the default), on a line, or at their geometric mean"},
        STUDY_PRINT_BOOTSTRAP_ROW(AT(n_bootstrap), "records"),
        STUDY_PRINT_SEED_ROW(AT(seed)),
        STUDY_PRINT_HAZARD_ROW(AT(hazard)),
        {"curves", 0, "N", OPTION_WHOLE, 0, AT(n_curve), 1, DEMANDS_MAX,
         .what = "a number of demands",
         .doc = "prints the intensities at which 16, 50 and 84 % of the records reach N demands"},
        {"points", .kind = OPTION_SET, .at = AT(points), .set = 1,
         .doc = "prints every run in place of the intensities found"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "a table separated by tabs, with the median and dispersion of each group"},
        {0}};
    static const struct option_part parts[] = {{.row = rows},
                                               {.row = printer_rows, .at = AT(form)},
                                               {.row = option_help},
                                               {.text = explanation},
                                               {0}};
    static const struct deck_command c = {&command_ida, parts, .settle = settle,
                                          .use_plan = use_plan};
    struct options o = {.n_thread = deck_command_threads(), .seed = BOOTSTRAP_SEED};
    return deck_command_run(&c, argc, argv, &o.load);
}
