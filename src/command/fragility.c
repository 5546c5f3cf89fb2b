// SPDX-License-Identifier: GPL-3.0-or-later
// jostle fragility: lognormal fragility curves of a study, with the counts they follow from.
#include <math.h>
#include <string.h>

#include "command/cells.h"
#include "command/suite_options.h"
#include "core/arena.h"
#include "jostle/result.h"
#include "study/fragility.h"

static int fragility_command(int argc, char **argv);

const struct command command_fragility = {
    .name = "fragility",
    .usage = "FILE.h5 [--tsv|--csv] --edp EDP --limit VALUE[,VALUE...] [--im NAME] "
             "[--over NAME] [--at NAME=VALUE]",
    .summary = "fits lognormal fragility curves to a study",
    .run = fragility_command,
};

enum form { FORM_TEXT, FORM_TSV, FORM_CSV };
struct request {
    struct suite_options suite;
    enum form form;
};

// What is printed of one group of runs and one limit.
struct result {
    const struct suite *suite;
    int group;
    double limit;
    const struct fragility_level *level;  // (n_point)
    struct fragility fit;
};

static int help(void) {
    printf("usage: jostle %s %s\n\n%s\n\n", command_fragility.name, command_fragility.usage,
           command_fragility.summary);
    printf("  --edp EDP      the demand, such as drift:A\n"
           "  --limit VALUE[,VALUE...]\n"
           "                 what it is not to exceed: 20mm, 0.5%%, 2MN; without a unit, in those\n"
           "                 of the deck\n"
           "  --im NAME      the sweep that is the intensity (default: im, sa, pga, intensity or\n"
           "                 scale, or the only sweep of numbers)\n"
           "%s"
           "  --tsv, --csv   a line for each limit and intensity\n"
           "  --help         this text\n",
           suite_options_help);
    suite_options_print_edps();
    printf("\nThe median and the dispersion are those of largest likelihood for the counts (Baker\n"
           "2015, Earthquake Spectra 31, 579-599). A value equal to the limit does not exceed it.\n"
           "Standard errors are those of independent runs.\n");
    return EXIT_DONE;
}

static const char *unit_of(const struct suite *s) {
    return strcmp(s->edp.units, "1") == 0 ? "" : s->edp.units;
}

static void print_parameters(const struct result *r) {
    const struct fragility *f = &r->fit;
    const char *unit = r->suite->abscissa_units;
    if (f->outcome == FRAGILITY_FITTED) {
        printf("median %.4g%s%s, dispersion %.4g; standard errors: %.2g of ln median, %.2g of the "
               "dispersion\n",
               f->median, unit[0] ? " " : "", unit, f->dispersion, f->log_median_error,
               f->dispersion_error);
        return;
    }
    printf("no curve: %s", fragility_reason(f));
    const char *blank = unit[0] ? " " : "";
    if (f->outcome == FRAGILITY_SEPARATED && f->between[0] < f->between[1]) {
        printf("; the median is between %.4g and %.4g%s%s", f->between[0], f->between[1], blank,
               unit);
    } else if (f->outcome == FRAGILITY_SEPARATED) {
        printf("; only at %.4g%s%s are there both", f->between[0], blank, unit);
    }
    printf("\n");
}

// A share of one; NaN: there is none.
static void print_share(double share) {
    if (isnan(share)) {
        printf(" %9s", "-");
    } else {
        printf(" %9.3f", share);
    }
}

static void print_text(const struct result *r) {
    const struct suite *s = r->suite;
    const char *unit = unit_of(s);
    char head[64];
    printf("\n%s > %.6g%s%s%s%s\n", s->edp.text, r->limit, unit[0] ? " " : "", unit,
           s->group[r->group][0] ? ", " : "", s->group[r->group]);
    snprintf(head, sizeof head, "%s%s%s%s", s->abscissa->name, s->abscissa_units[0] ? " [" : "",
             s->abscissa_units, s->abscissa_units[0] ? "]" : "");
    printf("%16s %7s %9s  %9s %9s\n", head, "n", "exceeded", "fraction", "curve");
    for (int j = 0; j < s->n_point; j++) {
        const struct fragility_level *l = &r->level[j];
        printf("%16.6g %7d %9d ", l->intensity, l->n, l->exceeded);
        print_share(l->n > 0 ? (double)l->exceeded / l->n : (double)NAN);
        print_share(fragility_probability(&r->fit, l->intensity));
        printf("\n");
    }
    print_parameters(r);
}

static void cell_of_fit(struct cells *c, const struct result *r, double value) {
    if (r->fit.outcome == FRAGILITY_FITTED) {
        cells_number(c, value);
    } else {
        cells_empty(c);
    }
}

static void print_cells(const struct result *r, struct cells *c) {
    const struct suite *s = r->suite;
    const struct fragility *f = &r->fit;
    for (int j = 0; j < s->n_point; j++) {
        const struct fragility_level *l = &r->level[j];
        cells_text(c, s->edp.text);
        cells_number(c, r->limit);
        cells_text(c, s->edp.units);
        cells_text(c, s->group[r->group]);
        cells_number(c, l->intensity);
        cells_text(c, s->abscissa_units[0] ? s->abscissa_units : "1");
        cells_whole(c, l->n);
        cells_whole(c, l->exceeded);
        cell_of_fit(c, r, fragility_probability(f, l->intensity));
        cell_of_fit(c, r, f->median);
        cell_of_fit(c, r, f->dispersion);
        cell_of_fit(c, r, f->log_median_error);
        cell_of_fit(c, r, f->dispersion_error);
        cells_text(c, f->outcome == FRAGILITY_FITTED ? "fitted" : fragility_reason(f));
        cells_end(c);
    }
}

static void print_head(const struct request *q, const struct suite *s, struct cells *c) {
    if (q->form != FORM_TEXT) {
        cells_words(c, "edp limit limit_unit group im im_unit n exceeded probability median "
                       "dispersion ln_median_error dispersion_error outcome");
        cells_end(c);
        return;
    }
    printf("%s%s", s->view->title, s->view->title[0] ? "\n" : "");
    printf("fragility over %s", s->abscissa->name);
    if (s->over[0]) {
        printf(", %d sample%s of %s", s->n_sample, s->n_sample == 1 ? "" : "s", s->over);
    }
    printf("%s%s\n", s->fixed[0] ? "; " : "", s->fixed);
}

static int print_all(const struct request *q, const struct suite *s, const double *limit, int n,
                     struct error *e) {
    struct fragility_level *level = arena_alloc(s->arena, (size_t)s->n_point, sizeof *level);
    struct cells c = {.to = stdout, .form = q->form == FORM_CSV ? CELLS_CSV : CELLS_TSV};
    if (!level) {
        return error_no_memory(e);
    }
    print_head(q, s, &c);
    for (int i = 0; i < n * s->n_group; i++) {
        struct result r = {
            .suite = s, .group = i % s->n_group, .limit = limit[i / s->n_group], .level = level};
        fragility_count(s, r.group, r.limit, level);
        int status = fragility_fit(level, s->n_point, &r.fit, e);
        if (status != STATUS_OK) {
            return status;
        }
        if (q->form == FORM_TEXT) {
            print_text(&r);
        } else {
            print_cells(&r, &c);
        }
    }
    return STATUS_OK;
}

static int fit_all(const struct request *q, const struct suite *s, struct error *e) {
    double *limit = NULL;
    int n = 0, status = suite_options_limits(&q->suite, s, &limit, &n, e);
    if (status == STATUS_OK && !s->abscissa->number) {
        status =
            error_set(e, STATUS_INPUT, "--im %s: its values are no numbers", s->abscissa->name);
    }
    if (status == STATUS_OK) {
        suite_options_warn(s);
        status = print_all(q, s, limit, n, e);
    }
    return status;
}

static int open_and_fit(const struct request *q, const char *path) {
    struct study_file *f;
    struct suite *s;
    struct error e;
    if (!study_file_is_study(path)) {
        struct result_file *file;
        if (result_open(path, &file, &e) == STATUS_OK) {
            result_close(file);
            error_set(&e, STATUS_INPUT, "%s is one analysis, not a study", path);
        }
        return command_fail(&e);
    }
    if (study_file_open(path, &f, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = suite_create(f, &q->suite.request, &s, &e);
    if (status == STATUS_OK) {
        status = fit_all(q, s, &e);
        suite_free(s);
    }
    study_file_close(f);
    return status == STATUS_OK ? EXIT_DONE : command_fail(&e);
}

// Returns -1 when there is something to do, else the exit status.
static int parse(int argc, char **argv, struct request *q) {
    static const struct option option[] = {SUITE_OPTIONS,
                                           {"tsv", no_argument, NULL, 't'},
                                           {"csv", no_argument, NULL, 'c'},
                                           {"help", no_argument, NULL, 'h'},
                                           {NULL, 0, NULL, 0}};
    opterr = 0;
    optind = 1;
    for (int c; (c = getopt_long(argc, argv, ":h", option, NULL)) != -1;) {
        int done = -1;
        if (c == 'h') {
            done = help();
        } else if (suite_options_has(c)) {
            const int status = suite_options_take(&command_fragility, c, &q->suite);
            done = status == EXIT_DONE ? -1 : status;
        } else if (c != 't' && c != 'c') {
            done = command_bad_option(&command_fragility, c, argv);
        } else if (q->form != FORM_TEXT && q->form != (c == 't' ? FORM_TSV : FORM_CSV)) {
            done = command_usage(&command_fragility, "--tsv and --csv exclude each other");
        } else {
            q->form = c == 't' ? FORM_TSV : FORM_CSV;
        }
        if (done >= 0) {
            return done;
        }
    }
    if (argc - optind != 1) {
        return command_usage(&command_fragility, "one result file is expected, not %d",
                             argc - optind);
    }
    if (!q->suite.request.edp || !q->suite.limits) {
        return command_usage(&command_fragility, "give --edp EDP and --limit VALUE");
    }
    return -1;
}

static int fragility_command(int argc, char **argv) {
    struct request q = {.form = FORM_TEXT};
    struct error e;
    if (suite_options_init(&q.suite, argc, &e) != STATUS_OK) {
        return command_fail(&e);
    }
    int status = parse(argc, argv, &q);
    if (status < 0) {
        status = open_and_fit(&q, argv[optind]);
    }
    suite_options_close(&q.suite);
    return status;
}
