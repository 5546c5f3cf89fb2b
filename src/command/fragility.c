// SPDX-License-Identifier: GPL-3.0-or-later
// jostle fragility: lognormal fragility curves of a study, with the counts they follow from.
#include <math.h>

#include "command/crash.h"
#include "command/fragility_print.h"
#include "command/study_deck.h"
#include "command/study_print.h"
#include "command/suite_options.h"
#include "core/arena.h"
#include "core/safe.h"

static int fragility_command(int argc, char **argv);

const struct command command_fragility = {
    .name = "fragility",
    .usage = "FILE.h5 [--tsv|--csv|--json] --edp EDP --limit VALUE[,VALUE...]|--collapse\n"
             "                        [--im NAME] [--over NAME] [--at NAME=VALUE] [--deck DECK]\n"
             "                        [--failed above|left-out] [--method counts|ida|cloud]\n"
             "                        [--bootstrap N [--seed S]] [--hazard FILE]",
    .summary = "fits lognormal fragility curves to a study",
    .run = fragility_command,
};

struct request {
    struct suite_options suite;
    enum fragility_method method;
    const char *deck;    // of the study; NULL: that which the file names
    const char *hazard;  // path of a hazard curve; NULL: none
    int n_bootstrap, seed;
    enum printer_form form;
};
#define AT(member) offsetof(struct request, member)

// A fit, with room for that of a bootstrap.
struct fitting {
    struct fragility_result *result;
    struct fragility_level *level;    // (n)
    struct fragility_record *record;  // (n)
    int *stratum;                     // (n)
    struct cloud cloud;
};

// The fit of the units, each of which counts `weight` times.
static int fit_weighted(void *context, const int *weight, struct fragility *out, struct error *e) {
    struct fitting *f = context;
    struct fragility_result *r = f->result;
    int n, status;
    switch (r->method) {
        case METHOD_COUNTS:
            n = fragility_runs_count(&r->runs, r->limit, weight, f->level);
            return fragility_fit(f->level, n, out, e);
        case METHOD_IDA:
            return bootstrap_fit_records(
                &(struct bootstrap_records){r->record, r->runs.n_unit, f->record}, weight, out, e);
        default:
            status = cloud_fit(&r->runs, weight, r->limit, edp_is_collapse(&r->suite->edp),
                               &f->cloud, e);
            *out = f->cloud.fit;
            return status;
    }
}

// Stripes with records of their own: the bootstrap draws runs of one intensity for each other.
// Where each run has another intensity, it draws among all.
static void set_strata(const struct fragility_runs *r, int *stratum) {
    for (int i = 0; i < r->n; i++) {
        const bool higher = i > 0 && r->run[i].intensity > r->run[i - 1].intensity;
        stratum[i] = i > 0 ? stratum[i - 1] + higher : 0;
    }
}

static int fit(const struct request *q, struct fitting *f, struct error *e) {
    struct fragility_result *r = f->result;
    fragility_runs_take(&r->runs, r->suite, r->group);
    r->n_level = fragility_runs_count(&r->runs, r->limit, NULL, r->level);
    if (r->method == METHOD_IDA) {
        fragility_runs_first(&r->runs, r->limit, r->record);
    }
    int status = fit_weighted(f, NULL, &r->fit, e);
    r->cloud = f->cloud;
    if (status == STATUS_OK && q->n_bootstrap > 0 && r->fit.outcome == FRAGILITY_FITTED) {
        struct bootstrap_request b = {.n_unit = r->runs.n_unit,
                                      .n_draw = q->n_bootstrap,
                                      .seed = q->seed,
                                      .fit = fit_weighted,
                                      .context = f};
        if (r->runs.each && r->method == METHOD_COUNTS && r->n_level < r->runs.n) {
            set_strata(&r->runs, f->stratum);
            b.stratum = f->stratum;
        }
        status = bootstrap_run(&b, &r->bootstrap, e);
    }
    if (status == STATUS_OK) {
        r->rate = study_print_find_rate(r->hazard, &r->fit, r->suite->abscissa_units);
    }
    return status;
}

static int allocate(struct fitting *f, struct error *e) {
    struct fragility_result *r = f->result;
    struct arena *a = r->suite->arena;
    int status = fragility_runs_create(r->suite, &r->runs, e);
    const size_t n = (size_t)r->runs.n;
    r->level = arena_alloc(a, n, sizeof *r->level);
    r->record = arena_alloc(a, n, sizeof *r->record);
    f->level = arena_alloc(a, n, sizeof *f->level);
    f->record = arena_alloc(a, n, sizeof *f->record);
    f->stratum = arena_alloc(a, n, sizeof *f->stratum);
    return status == STATUS_OK && arena_failed(a) ? error_no_memory(e) : status;
}

static void print_head(const struct suite *s) {
    char over[32] = "";
    if (s->view->title[0]) {
        safe_line(stdout, "%s", s->view->title);
    }
    if (s->over[0]) {
        snprintf(over, sizeof over, ", %d sample%s of ", s->n_sample, s->n_sample == 1 ? "" : "s");
    }
    safe_line(stdout, "fragility over %s%s%s%s%s", s->im, over, s->over, s->fixed[0] ? "; " : "",
              s->fixed);
}

static int print_all(const struct request *q, const struct suite *s, const struct hazard *hazard,
                     const double *limit, int n, struct error *e) {
    struct fragility_result r = {
        .suite = s, .method = q->method, .hazard = hazard, .bootstrap = {.n_draw = q->n_bootstrap}};
    const struct bootstrap none = {q->seed, q->n_bootstrap, 0, {NAN, NAN}, {NAN, NAN}};
    struct fitting f = {.result = &r};
    struct printer t = {.to = stdout, .form = q->form};
    int status = allocate(&f, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (q->form == FORM_TEXT) {
        print_head(s);
    } else {
        fragility_print_columns(&r, &t);
        printer_head(&t);
    }
    for (int i = 0; i < n * s->n_group && status == STATUS_OK; i++) {
        r.group = i % s->n_group;
        r.limit = limit[i / s->n_group];
        r.bootstrap = none;
        status = fit(q, &f, e);
        if (status == STATUS_OK && q->form == FORM_TEXT) {
            status = fragility_print_text(&r, e);
        } else if (status == STATUS_OK) {
            fragility_print_data(&r, &t);
        }
    }
    return printer_end(&t, status, e);
}

// Can first exceedances be found? Where a demand that is never below 0 does not exceed 0 it is 0,
// and a straight line from there begins at the intensity below, wherever the crossing is.
static int check_ida(const struct suite *s, const double *limit, int n, struct error *e) {
    const struct edp_quantity *quantity = s->edp.quantity;
    if (s->mixed) {
        return error_set(e, STATUS_INPUT,
                         "--method ida: '%s' is %s, along which other things change, too",
                         s->abscissa->name, s->mixed);
    }
    if (s->n_sample < 2) {
        return error_set(e, STATUS_INPUT,
                         "--method ida needs samples; name their sweep with --over");
    }
    for (int i = 0; i < n; i++) {
        if (limit[i] == 0.0 && quantity->reduction != EDP_HIGHEST && !edp_is_collapse(&s->edp)) {
            return error_set(
                e, STATUS_INPUT,
                "--method ida cannot locate the first exceedance of 0 on %s, which is 0 "
                "until the first contact; use --method counts%s",
                s->edp.text, quantity->owner == EDP_OF_CONTACT ? ", or --edp penetration" : "");
        }
    }
    return STATUS_OK;
}

// Whether the suite is one that the method can do with.
static int check_suite(const struct request *q, const struct suite *s, const double *limit, int n,
                       struct error *e) {
    if (s->point_name && !s->intensity) {
        return error_set(e, STATUS_INPUT, "--im %s: %s", s->abscissa->name,
                         s->mixed ? "it only numbers paired sweeps" : "its values are not numbers");
    }
    return q->method == METHOD_IDA ? check_ida(s, limit, n, e) : STATUS_OK;
}

static int fit_all(const struct request *q, const struct suite *s, struct error *e) {
    double *limit = NULL;
    struct hazard hazard;
    int n = 0, status = suite_options_limits(&q->suite, s, &limit, &n, e);
    if (status == STATUS_OK) {
        status = check_suite(q, s, limit, n, e);
    }
    if (status == STATUS_OK && q->hazard) {
        status =
            hazard_read(s->arena, q->hazard, s->abscissa_dimension, s->abscissa_size, &hazard, e);
    }
    if (status == STATUS_OK) {
        suite_options_warn(s);
        status = print_all(q, s, q->hazard ? &hazard : NULL, limit, n, e);
    }
    return status;
}

static int open_and_fit(struct request *q, const char *path) {
    struct study_file *f;
    struct suite *s;
    struct error e;
    crash_reading(NULL, path);
    if (study_file_open(path, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = study_deck_suite(f, q->deck, *suite_options_request(&q->suite), &s);
    if (status == EXIT_DONE) {
        status = fit_all(q, s, &e) == STATUS_OK ? EXIT_DONE : command_fail(&e);
        suite_free(s);
    }
    study_file_close(f);
    return status;
}

static int use(void *request, struct arena *a, const struct words *operand) {
    (void)a;
    struct request *q = request;
    const char *wrong = suite_options_collapse(&q->suite);
    if (wrong) {
        return command_usage(&command_fragility, "%s", wrong);
    }
    return q->suite.request.edp && q->suite.limits
               ? open_and_fit(q, operand->word[0])
               : command_usage(&command_fragility,
                               "give --edp EDP and --limit VALUE, or --collapse");
}

static const struct option_row rows[] = {
    {"edp", 0, "EDP", OPTION_TEXT, 0, AT(suite.request.edp), .doc = "the demand, such as drift:A"},
    {"limit", 0, "VALUE[,VALUE...]", OPTION_TEXT, 0, AT(suite.limits),
     .doc = "limits of the demand: 20mm, 0.5%, 2MN; default unit: that of the deck"},
    {"im", 0, "NAME", OPTION_TEXT, 0, AT(suite.request.abscissa),
     .doc = "the sweep that is the intensity (default: im, sa, pga, intensity or scale, or the "
            "only sweep of numbers), or a measure of the ground motions, such as PGV or Sa(1s)"},
    STUDY_DECK_ROW(AT(deck)),
    {0}};

static const struct option_row form_rows[] = {
    {"method", 0, "counts|ida|cloud", OPTION_CHOICE, 0, AT(method),
     .doc = "fits the counts at each intensity (the default), the intensity at which each sample "
            "first exceeds the limit, or the regression of the demand on the intensity"},
    STUDY_PRINT_BOOTSTRAP_ROW(AT(n_bootstrap), "samples"),
    STUDY_PRINT_SEED_ROW(AT(seed)),
    STUDY_PRINT_HAZARD_ROW(AT(hazard)),
    {"tsv", .kind = OPTION_SET, .at = AT(form), .set = FORM_TSV,
     .doc = "a line for each limit and intensity, separated by tabs"},
    {0}};

static int fragility_command(int argc, char **argv) {
    static const struct option_part parts[] = {
        {.row = rows},
        {.row = suite_options_rows, .at = AT(suite)},
        {.row = form_rows},
        {.row = printer_rows, .at = AT(form)},
        {.row = option_help},
        {.print = suite_options_print_edps},
        {.text = measure_help},
        {.text =
             "\nThe median and the dispersion maximise the likelihood of the counts (Baker 2015, "
             "Earthquake Spectra\n31, 579-599), or of the first exceedances. A value equal to the "
             "limit does not exceed it.\nStandard errors hold for independent runs or samples.\n"},
        {0}};
    static const struct option_list list = {&command_fragility, parts, .operand = "result file",
                                            .use = use};
    struct request q = {.form = FORM_TEXT, .seed = BOOTSTRAP_SEED};
    return option_run(&list, argc, argv, &q);
}
