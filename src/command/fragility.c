// SPDX-License-Identifier: GPL-3.0-or-later
// jostle fragility: lognormal fragility curves of a study, with the counts they follow from.
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

#include "command/crash.h"
#include "command/printer.h"
#include "command/study_print.h"
#include "command/suite_options.h"
#include "core/arena.h"
#include "core/safe.h"
#include "study/hazard.h"

static int fragility_command(int argc, char **argv);

const struct command command_fragility = {
    .name = "fragility",
    .usage = "FILE.h5 [--tsv|--csv|--json] --edp EDP --limit VALUE[,VALUE...]|--collapse\n"
             "                        [--im NAME] [--over NAME] [--at NAME=VALUE]\n"
             "                        [--failed above|left-out] [--method counts|ida]\n"
             "                        [--hazard FILE]",
    .summary = "fits lognormal fragility curves to a study",
    .run = fragility_command,
};

enum method { METHOD_COUNTS, METHOD_IDA };
static const char *const method_name[] = {"counts", "ida"};
struct request {
    struct suite_options suite;
    enum method method;
    const char *hazard;  // path of a hazard curve; NULL: none
    enum printer_form form;
};
#define AT(member) offsetof(struct request, member)

// Of text, behind the intensity.
static const struct printer_column level_columns[] = {
    COLUMN_TEXT("n", 7), COLUMN_TEXT("exceeded", 9), COLUMN_F("fraction", 10, 3),
    COLUMN_F("curve", 9, 3)};
// Of data, before and behind the sweeps of the groups.
static const struct printer_column of_limit[] = {COLUMN_DATA("edp"), COLUMN_DATA("limit"),
                                                 COLUMN_DATA("limit_unit")};
static const struct printer_column of_level[] = {
    COLUMN_DATA("im"),         COLUMN_DATA("im_unit"),         COLUMN_DATA("n"),
    COLUMN_DATA("exceeded"),   COLUMN_DATA("probability"),     COLUMN_DATA("median"),
    COLUMN_DATA("dispersion"), COLUMN_DATA("ln_median_error"), COLUMN_DATA("dispersion_error"),
    COLUMN_DATA("method"),     COLUMN_DATA("never"),           COLUMN_DATA("always"),
    COLUMN_DATA("outcome")};
// With a hazard curve: behind a level, the part of the rate that intensities up to it give.
static const struct printer_column of_hazard_level[] = {COLUMN_G("rate up to", 12, 4)};
static const struct printer_column of_hazard[] = {COLUMN_DATA("annual_rate"),
                                                  COLUMN_DATA("annual_rate_up_to")};

// What is printed of one group of runs and one limit.
struct result {
    const struct suite *suite;
    int group;
    double limit;
    enum method method;
    const struct hazard *hazard;      // NULL: none
    struct fragility_level *level;    // (n_point)
    struct fragility_record *record;  // (n_sample), by METHOD_IDA
    struct fragility fit;
    double rate;  // of exceedance in a year; NAN: there is none
};

// Where all runs are on one side of the limit, how far they are from it: it may be in a wrong unit.
static void print_distance(const struct result *r) {
    const bool none = r->fit.outcome == FRAGILITY_NONE_EXCEEDS;
    const size_t n = (size_t)r->suite->n_sample * (size_t)r->suite->n_point;
    const double *of = r->suite->value + (size_t)r->group * n;  // NaN where one is left out
    const double demand = none ? gsl_stats_max(of, 1, n) : gsl_stats_min(of, 1, n);
    const char *unit = unit_suffix(r->suite->edp.units);
    if ((none || r->fit.outcome == FRAGILITY_ALL_EXCEED) && isfinite(demand)) {
        printf("; the %s ", none ? "largest" : "smallest");
        safe_put(stdout, SAFE_TERMINAL, r->suite->edp.text);
        printf(" is %.4g%s%s", demand, unit[0] ? " " : "", unit);
    }
}

static void print_parameters(const struct result *r) {
    const struct fragility *f = &r->fit;
    const char *unit = r->suite->abscissa_units, *blank = unit[0] ? " " : "";
    if (f->outcome == FRAGILITY_FITTED) {
        study_print_curve(f, unit, &r->suite->view->units);
        if (r->hazard) {
            study_print_rate(r->rate);
        }
        return;
    }
    printf("no curve: %s", fragility_reason(f));
    if (f->outcome == FRAGILITY_SEPARATED && f->between[0] < f->between[1]) {
        printf("; the median is between %.4g and %.4g%s%s", f->between[0], f->between[1], blank,
               unit);
    } else if (f->outcome == FRAGILITY_SEPARATED) {
        printf("; only at %.4g%s%s are there both", f->between[0], blank, unit);
    }
    print_distance(r);
    printf("\n");
}

static int count_crossings(const struct result *r, enum fragility_crossing crossing) {
    int n = 0;
    for (int k = 0; k < r->suite->n_sample; k++) {
        n += r->record[k].crossing == crossing;
    }
    return n;
}

// How many samples have such a crossing, and which ones if it is none.
static void print_crossings(const struct result *r, enum fragility_crossing crossing,
                            const char *what) {
    const struct suite *s = r->suite;
    const int n = count_crossings(r, crossing);
    if (n == 0) {
        return;
    }
    printf("%d of %d samples %s", n, s->n_sample, what);
    const char *comma = ": ";
    for (int k = 0; k < s->n_sample && crossing != CROSSING_AT; k++) {
        if (r->record[k].crossing == crossing) {
            fputs(comma, stdout);
            safe_put(stdout, SAFE_TERMINAL, s->sample[k]);
            comma = ", ";
        }
    }
    printf("\n");
}

static int print_text(const struct result *r, struct error *e) {
    const struct suite *s = r->suite;
    const char *unit = unit_suffix(s->edp.units);
    struct printer t = {.to = stdout};
    printer_add(&t,
                &(struct printer_column){
                    .head = s->abscissa->name, .unit = s->abscissa_units, .width = 16, .digits = 6},
                1);
    PRINTER_ADD(&t, level_columns);
    if (r->hazard) {
        PRINTER_ADD(&t, of_hazard_level);
    }
    putchar('\n');
    safe_put(stdout, SAFE_TERMINAL, s->edp.text);
    if (!edp_is_collapse(&s->edp)) {
        printf(" > %.6g%s%s%s", r->limit, unit[0] ? " " : "", unit,
               study_print_g(&s->view->units, s->edp.units, r->limit).added);
    }
    safe_line(stdout, "%s%s", s->group[r->group][0] ? ", " : "", s->group[r->group]);
    printer_head(&t);
    for (int j = 0; j < s->n_point; j++) {
        const struct fragility_level *l = &r->level[j];
        printer_number(&t, l->intensity);
        printer_whole(&t, l->n);
        printer_whole(&t, l->exceeded);
        printer_number(&t, l->n > 0 ? (double)l->exceeded / l->n : (double)NAN);
        printer_number(&t, fragility_probability(&r->fit, l->intensity));
        if (r->hazard) {
            printer_number(&t, hazard_exceedances(r->hazard, &r->fit, l->intensity));
        }
        printer_line(&t);
    }
    if (r->method == METHOD_IDA) {
        print_crossings(r, CROSSING_AT, "first exceed the limit between two intensities");
        print_crossings(r, CROSSING_ABOVE,
                        "never exceed it and count as above their highest intensity");
        print_crossings(r, CROSSING_BELOW,
                        "always exceed it and count as below their lowest intensity");
        print_crossings(r, CROSSING_NO_RUNS, "have no runs and are left out");
    }
    print_parameters(r);
    return printer_end(&t, STATUS_OK, e);
}

// A number of the curve; an empty cell where there is none.
static void print_fitted(struct printer *t, const struct fragility *f, double value) {
    if (f->outcome == FRAGILITY_FITTED) {
        printer_number(t, value);
    } else {
        printer_empty(t);
    }
}

static void print_data(const struct result *r, struct printer *t) {
    const struct suite *s = r->suite;
    const struct fragility *f = &r->fit;
    const bool ida = r->method == METHOD_IDA;
    for (int j = 0; j < s->n_point; j++) {
        const struct fragility_level *l = &r->level[j];
        printer_text(t, s->edp.text);
        printer_number(t, r->limit);
        printer_text(t, s->edp.units);
        for (int i = 0; i < s->n_group_sweep; i++) {
            printer_sweep(t, s->view->sweep[s->group_sweep[i]], suite_group_choice(s, r->group, i));
        }
        printer_number(t, l->intensity);
        printer_text(t, s->abscissa_units[0] ? s->abscissa_units : "1");
        printer_whole(t, l->n);
        printer_whole(t, l->exceeded);
        print_fitted(t, f, fragility_probability(f, l->intensity));
        print_fitted(t, f, f->median);
        print_fitted(t, f, f->dispersion);
        print_fitted(t, f, f->log_median_error);
        print_fitted(t, f, f->dispersion_error);
        printer_text(t, method_name[r->method]);
        printer_sign(t, ida ? count_crossings(r, CROSSING_ABOVE) : -1);
        printer_sign(t, ida ? count_crossings(r, CROSSING_BELOW) : -1);
        printer_text(t, f->outcome == FRAGILITY_FITTED ? "fitted" : fragility_reason(f));
        if (r->hazard) {
            print_fitted(t, f, r->rate);
            print_fitted(t, f, hazard_exceedances(r->hazard, f, l->intensity));
        }
        printer_line(t);
    }
}

static int fit(struct result *r, struct error *e) {
    const struct suite *s = r->suite;
    int status;
    fragility_count(s, r->group, r->limit, r->level);
    if (r->method == METHOD_COUNTS) {
        status = fragility_fit(r->level, s->n_point, &r->fit, e);
    } else {
        fragility_first(s, r->group, r->limit, r->record);
        status = fragility_fit_records(r->record, s->n_sample, &r->fit, e);
    }
    if (status == STATUS_OK) {
        r->rate = study_print_find_rate(r->hazard, &r->fit, s->abscissa_units);
    }
    return status;
}

static int print_all(const struct request *q, const struct suite *s, const struct hazard *hazard,
                     const double *limit, int n, struct error *e) {
    struct result r = {.suite = s, .method = q->method, .hazard = hazard};
    struct printer t = {.to = stdout, .form = q->form};
    r.level = arena_alloc(s->arena, (size_t)s->n_point, sizeof *r.level);
    r.record = arena_alloc(s->arena, (size_t)s->n_sample, sizeof *r.record);
    if (!r.level || !r.record) {
        return error_no_memory(e);
    }
    if (q->form == FORM_TEXT) {
        char over[32] = "";
        if (s->view->title[0]) {
            safe_line(stdout, "%s", s->view->title);
        }
        if (s->over[0]) {
            snprintf(over, sizeof over, ", %d sample%s of ", s->n_sample,
                     s->n_sample == 1 ? "" : "s");
        }
        safe_line(stdout, "fragility over %s%s%s%s%s", s->abscissa->name, over, s->over,
                  s->fixed[0] ? "; " : "", s->fixed);
    } else {
        PRINTER_ADD(&t, of_limit);
        for (int i = 0; i < s->n_group_sweep; i++) {
            printer_add_sweep(&t, s->view->sweep[s->group_sweep[i]]);
        }
        PRINTER_ADD(&t, of_level);
        if (hazard) {
            PRINTER_ADD(&t, of_hazard);
        }
        printer_head(&t);
    }
    int status = STATUS_OK;
    for (int i = 0; i < n * s->n_group && status == STATUS_OK; i++) {
        r.group = i % s->n_group;
        r.limit = limit[i / s->n_group];
        status = fit(&r, e);
        if (status == STATUS_OK && q->form == FORM_TEXT) {
            status = print_text(&r, e);
        } else if (status == STATUS_OK) {
            print_data(&r, &t);
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
    if (s->point_name) {
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
    int status = suite_create(f, suite_options_request(&q->suite), &s, &e);
    if (status == STATUS_OK) {
        status = fit_all(q, s, &e);
        suite_free(s);
    }
    study_file_close(f);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
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
            "only sweep of numbers)"},
    {0}};

static const struct option_row form_rows[] = {
    {"method", 0, "counts|ida", OPTION_CHOICE, 0, AT(method),
     .doc = "fits the counts at each intensity (the default), or the intensity at which each "
            "sample first exceeds the limit"},
    {"hazard", 0, "FILE", OPTION_TEXT, 0, AT(hazard),
     .doc = "rows of intensity and mean annual rate of exceedance at the site: prints how often in "
            "a year the limit is exceeded"},
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
        {.text =
             "\nThe median and the dispersion maximise the likelihood of the counts (Baker 2015, "
             "Earthquake Spectra\n31, 579-599), or of the first exceedances. A value equal to the "
             "limit does not exceed it.\nStandard errors hold for independent runs or samples.\n"},
        {0}};
    static const struct option_list list = {&command_fragility, parts, .operand = "result file",
                                            .use = use};
    struct request q = {.form = FORM_TEXT};
    return option_run(&list, argc, argv, &q);
}
