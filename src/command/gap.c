// SPDX-License-Identifier: GPL-3.0-or-later
// jostle gap: the gap that buildings need. Without --limit, how near they come when they never
// touch, next to what rules give; with it, the gap beyond which the limit is met.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command/deck_command.h"
#include "command/gap_print.h"
#include "command/progress.h"
#include "command/suite_options.h"
#include "core/quantity.h"

static int gap_command(int argc, char **argv);

const struct command command_gap = {
    .name = "gap",
    .usage =
        "DECK [--factor [BUILDING=]F]... [--gb INTENSITY] [--ntc ZONE] [-D NAME=VALUE]...\n"
        "                  [-j THREADS] [--tsv|--csv|--json]\n"
        "       jostle gap DECK --limit EDP=VALUE [--range FROM:TO:N] [--tolerance LENGTH]\n"
        "                  [--percentile P] [--parameter PARAM] [-D NAME=VALUE]... [-j THREADS]\n"
        "                  [--tsv|--csv|--json]",
    .summary = "finds the gap that avoids contact, or that meets a limit",
    .run = gap_command,
};

static const char explanation[] =
    "\nThe command runs all runs of the deck's sweeps and writes no file. Without --limit it opens "
    "all\ncontacts, keeps the links, and prints the largest closing displacement of each contact "
    "beside the\nseparations that codes require. With --limit it scans gaps and bisects the last "
    "change. A scan can\nmiss a limit that is exceeded between two gaps, because the response is "
    "not a monotone function of\nthe gap. Exit status 1: runs have failed, or no gap meets the "
    "limit.\n";

enum { POINTS_DEFAULT = 33 };

struct options {
    struct load_request load;
    int n_thread;
    enum printer_form form;
    const char *limit, *range, *tolerance, *percentile, *parameter;
    struct words factor;
    int gb, gb_type, ntc;  // intensity, 0: none; -1: none
};
#define AT(member) offsetof(struct options, member)

// Reads a word of --factor into the factors of its building, or of all.
static int parse_factor(const struct model *m, const char *word, double *factor) {
    const char *equals = strchr(word, '='), *number = equals ? equals + 1 : word;
    int only = -1;
    for (int i = 0; equals && i < m->n_building; i++) {
        const char *name = m->building[i].name;
        const size_t n = strlen(name);
        only = n == (size_t)(equals - word) && memcmp(name, word, n) == 0 ? i : only;
    }
    double value;
    if (equals && only < 0) {
        return command_usage(&command_gap, "--factor %s: the deck has no building of this name",
                             word);
    }
    if (!quantity_whole(number, &dimension_none, BARE_ALLOWED, &value) || !(value > 0.0)) {
        return command_usage(&command_gap,
                             "--factor takes a number > 0 or BUILDING=NUMBER, not '%s'", word);
    }
    for (int i = 0; i < m->n_building; i++) {
        factor[i] = only < 0 || only == i ? value : factor[i];
    }
    return EXIT_DONE;
}

// What the rules take from the options. `factor` has room for all buildings.
static int read_site(const struct plan *p, const struct options *o, double *factor,
                     struct separation_site *site) {
    // GB 50011-2010, 6.1.4: 20 mm more for each 5, 4, 3 or 2 m where the intensity is 6 to 9.
    static const double share[] = {1.0, 0.7, 0.5};
    // NTC (2004), 1.10: of the level, in zones I to III.
    static const double slope[] = {0.001, 0.003, 0.006};
    const struct model *m = p->first;
    *site = (struct separation_site){.factor = factor,
                                     .metre = 1.0 / m->deck->units.length,
                                     .gb_step = o->gb > 0 ? 11.0 - o->gb : 0.0,
                                     .gb_share = share[o->gb_type],
                                     .ntc_slope = o->ntc < 0 ? (double)NAN : slope[o->ntc]};
    for (int i = 0; i < m->n_building; i++) {
        factor[i] = 1.0;
    }
    const bool high = o->gb > 0 || o->ntc >= 0;
    for (int end = 0; end < 2 * m->n_contact && high; end++) {
        const int building = m->link[end / 2].building[end % 2];
        if (building != WALL && !m->building[building].height) {
            return command_usage(&command_gap, "%s needs the storey heights of building %s",
                                 o->gb > 0 ? "--gb" : "--ntc", m->building[building].name);
        }
    }
    int status = EXIT_DONE;
    for (int i = 0; i < o->factor.n && status == EXIT_DONE; i++) {
        status = parse_factor(m, o->factor.word[i], factor);
    }
    return status;
}

// EXIT_DONE, or the status of what ended the runs.
static int run_contact_free(const struct plan *p, const struct options *o,
                            const struct separation_site *site, struct contact_free *a) {
    struct progress progress;
    struct error e;
    const struct gap_runs how = {
        .n_thread = o->n_thread, .poll = progress_poll, .context = &progress};
    progress_start(&progress, (double)p->n_run, "runs");
    int status = contact_free_run(p, &how, site, a, &e);
    progress_end(&progress);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

static int fail_runs(const struct plan *p, const struct contact_free *a) {
    long run = 0;
    while (a->outcome[run].status != STUDY_FAILED) {
        run++;
    }
    struct plan_text t;
    struct error e;
    error_set(&e, STATUS_FAILED, "%ld of %ld runs failed, the first: %s: %s", a->n_failed, a->n_run,
              plan_describe(p, run, &t), a->outcome[run].message);
    return command_fail(&e);
}

static int print_contact_free(const struct plan *p, const struct options *o) {
    struct contact_free a = {.n_run = 0};
    struct separation_site site;
    double *factor = calloc((size_t)p->first->n_building, sizeof *factor);
    double *scratch = calloc((size_t)p->n_run, sizeof *scratch);
    int status = factor && scratch ? read_site(p, o, factor, &site) : command_no_memory();
    if (status == EXIT_DONE) {
        status = run_contact_free(p, o, &site, &a);
    }
    if (status == EXIT_DONE) {
        status = o->form == FORM_TEXT ? gap_print_contact_free(p, &a, &site, scratch)
                                      : gap_print_runs(p, &a, o->form);
    }
    if (status == EXIT_DONE && a.n_failed > 0) {
        status = fail_runs(p, &a);
    }
    free(scratch);
    free(factor);
    contact_free_close(&a);
    return status;
}

// From 0 to a thousandth beyond where nothing touches any more, or comes as near as the limit says.
static int default_range(const struct plan *p, const struct options *o,
                         struct gap_search_request *q) {
    struct contact_free a = {.n_run = 0};
    static const struct separation_site none = {.metre = 1.0};
    int status = run_contact_free(p, o, &none, &a);
    q->from = q->to = 0.0;
    q->n = POINTS_DEFAULT;
    for (long run = 0; status == EXIT_DONE && run < a.n_run; run++) {
        for (int i = 0; i < a.n_contact; i++) {
            q->to = fmax(q->to, contact_free_values(&a, run, i)[FREE_CLOSING]);
        }
    }
    // Only a penetration has limits below 0: the distance that is to be left.
    q->to += fmax(0.0, -q->limit);
    q->to *= 1.001;
    if (status == EXIT_DONE && a.n_failed > 0) {
        status = fail_runs(p, &a);
    }
    contact_free_close(&a);
    return status == EXIT_DONE && !(q->to > 0.0)
               ? command_usage(&command_gap, "the buildings never move towards each other; set the "
                                             "gaps to scan with --range")
               : status;
}

static int parse_range(const struct unit_system *u, const char *text,
                       struct gap_search_request *q) {
    double n;
    const char *at = quantity_word(text, u, &dimension_length, BARE_ALLOWED, &q->from);
    at =
        at && *at == ':' ? quantity_word(at + 1, u, &dimension_length, BARE_ALLOWED, &q->to) : NULL;
    at = at && *at == ':' ? quantity_word(at + 1, u, &dimension_none, BARE_ALLOWED, &n) : NULL;
    if (!at || *at || !(q->from >= 0.0 && q->from < q->to) ||
        !(n >= 2.0 && n <= GAP_POINTS_MAX && n == floor(n))) {
        return command_usage(&command_gap,
                             "--range takes FROM:TO:N, 0 <= FROM < TO and N from 2 to %d, not '%s'",
                             GAP_POINTS_MAX, text);
    }
    q->n = (int)n;
    return EXIT_DONE;
}

// A quantity from 0 to `most`.
static int parse_quantity(const char *option, const struct unit_system *u,
                          const struct dimension *dimension, const char *text, double most,
                          double *out) {
    const char *end = quantity_word(text, u, dimension, BARE_ALLOWED, out);
    if (end && !*end && *out >= 0.0 && *out <= most) {
        return EXIT_DONE;
    }
    char unit[64];
    unit_text(u, *dimension, unit, sizeof unit);
    return isinf(most) ? command_usage(&command_gap, "%s takes a value >= 0 in %s, not '%s'",
                                       option, unit, text)
                       : command_usage(&command_gap, "%s takes a number from 0 to %g, not '%s'",
                                       option, most, text);
}

static int run_search(const struct plan *p, const struct options *o) {
    struct gap_search_request q;
    const struct unit_system *u = &p->first->deck->units;
    q = (struct gap_search_request){.plan = p, .parameter = o->parameter, .percentile = 100.0};
    int status = suite_options_edp_limit(&command_gap, p, o->limit, &q.edp, &q.limit);
    if (status == EXIT_DONE && o->percentile) {
        status =
            parse_quantity("--percentile", u, &dimension_none, o->percentile, 100.0, &q.percentile);
    }
    if (status == EXIT_DONE && o->tolerance) {
        status = parse_quantity("--tolerance", u, &dimension_length, o->tolerance, INFINITY,
                                &q.tolerance);
    }
    if (status == EXIT_DONE) {
        status = o->range ? parse_range(u, o->range, &q) : default_range(p, o, &q);
    }
    q.tolerance = o->tolerance ? q.tolerance : (q.to - q.from) / 1000.0;
    if (status != EXIT_DONE) {
        return status;
    }
    struct gap_search s;
    struct error e;
    struct progress progress;
    const struct gap_runs how = {
        .n_thread = o->n_thread, .poll = progress_poll, .context = &progress};
    progress_start(&progress, (q.n + 1.0) * (double)p->n_run, "runs");
    status = gap_search_run(&q, &how, &s, &e);
    progress_end(&progress);
    if (status != STATUS_OK) {
        status = command_fail(&e);
    } else {
        status = gap_print_search(&q, &s, o->form);
        if (status == EXIT_DONE && !s.found) {
            error_set(&e, STATUS_FAILED, "no gap of the range meets the limit");
            status = command_fail(&e);
        }
    }
    gap_search_close(&s);
    return status;
}

static int use_plan(void *options, const struct plan *plan) {
    const struct options *o = options;
    struct error e;
    if (plan->first->n_contact == 0) {
        error_set(&e, STATUS_INPUT, "the deck has no contact");
        return command_fail(&e);
    }
    return o->limit ? run_search(plan, o) : print_contact_free(plan, o);
}

static int settle(void *options) {
    const struct options *o = options;
    const char *useless = o->range        ? "--range"
                          : o->tolerance  ? "--tolerance"
                          : o->percentile ? "--percentile"
                          : o->parameter  ? "--parameter"
                                          : NULL;
    if (useless && !o->limit) {
        return command_usage(&command_gap, "%s goes with --limit", useless);
    }
    const char *of_rules = o->factor.n > 0 ? "--factor"
                           : o->gb > 0     ? "--gb"
                           : o->ntc >= 0   ? "--ntc"
                                           : NULL;
    if (of_rules && o->limit) {
        return command_usage(&command_gap, "%s is for the rules, which --limit does not apply",
                             of_rules);
    }
    return o->gb_type > 0 && o->gb == 0 ? command_usage(&command_gap, "--gb-type goes with --gb")
                                        : EXIT_DONE;
}

static int gap_command(int argc, char **argv) {
    static const struct option_row rows[] = {
        DECK_DEFINE_ROW,
        DECK_THREADS_ROW(AT(n_thread), "threads, default: all cores"),
        {"limit", 0, "EDP=VALUE", OPTION_TEXT, 0, AT(limit),
         .doc = "finds the gap from which on the demand EDP is at most VALUE: drift-ratio=1%, "
                "force:A:5-B:5=2MN, impacts=0; default unit: that of the deck; jostle fragility "
                "--help lists the demands"},
        {"range", 0, "FROM:TO:N", OPTION_TEXT, 0, AT(range),
         .doc = "gaps to scan; default: 33 gaps from 0 to the largest closing displacement"},
        {"tolerance", 0, "LENGTH", OPTION_TEXT, 0, AT(tolerance),
         .doc = "tolerance of the bisection; default: a thousandth of the range"},
        {"percentile", 0, "P", OPTION_TEXT, 0, AT(percentile),
         .doc = "percentage of the runs that must meet the limit; default: 100"},
        {"parameter", 0, "PARAM", OPTION_TEXT, 0, AT(parameter),
         .doc = "parameter of the deck that sets the gap; default: all contacts get the gap"},
        {"factor", 0, "[BUILDING=]F", OPTION_WORDS, 0, AT(factor),
         .doc = "multiplies the displacements of a building, or of all, in the rules; the factor "
                "makes design displacements of those of the runs; may be repeated"},
        {"gb", 0, "INTENSITY", OPTION_WHOLE, 0, AT(gb), .least = 6, .most = 9,
         .doc = "adds the width after GB 50011-2010 for the intensity 6 to 9; needs heights"},
        {"gb-type", 0, "frame|frame-wall|wall", OPTION_CHOICE, 0, AT(gb_type),
         .doc = "structure for --gb: that of the two buildings which needs more; default: frame"},
        {"ntc", 0, "I|II|III", OPTION_CHOICE, 0, AT(ntc),
         .doc = "adds the separation after the NTC of Mexico City (2004) for the zone; needs "
                "heights"},
        {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
         .doc = "a table separated by tabs: every run and contact, or every gap"},
        {0}};
    static const struct option_part parts[] = {{.row = rows},
                                               {.row = printer_rows, .at = AT(form)},
                                               {.row = option_help},
                                               {.text = explanation},
                                               {0}};
    static const struct deck_command c = {&command_gap, parts, .settle = settle,
                                          .use_plan = use_plan};
    struct options o = {.n_thread = deck_command_threads(), .ntc = -1};
    return deck_command_run(&c, argc, argv, &o.load);
}
