// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/fragility_print.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>

#include "command/study_print.h"
#include "core/safe.h"

// Text lists so many intensities where each run may have its own.
enum { LEVELS_MAX = 40 };

static const char *const method_name[] = {"counts", "ida", "cloud"};

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
static const struct printer_column of_cloud[] = {COLUMN_DATA("intercept"), COLUMN_DATA("slope"),
                                                 COLUMN_DATA("scatter"),   COLUMN_DATA("collapsed"),
                                                 COLUMN_DATA("logit_0"),   COLUMN_DATA("logit_1")};

// Where all runs are on one side of the limit, how far they are from it: it may be in a wrong unit.
static void print_distance(const struct fragility_result *r) {
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

// " = A + B ln IM"
static void print_line(const char *before, double constant, double slope, const char *im) {
    printf("%s%.4g %c %.4g ln ", before, constant, slope < 0.0 ? '-' : '+', fabs(slope));
    safe_put(stdout, SAFE_TERMINAL, im);
}

// The line and the logit of a cloud.
static void print_cloud(const struct fragility_result *r) {
    const struct cloud *c = &r->cloud;
    if (isfinite(c->slope)) {
        printf("ln ");
        safe_put(stdout, SAFE_TERMINAL, r->suite->edp.text);
        print_line(" = ", c->intercept, c->slope, r->suite->im);
        printf(", scatter %.4g, of %d runs\n", c->scatter, c->n);
    }
    if (r->fit.mixed) {
        printf("collapse of %d of %d runs: ", c->n_collapsed, c->n + c->n_collapsed);
        print_line("logit ", r->fit.logit[0], r->fit.logit[1], r->suite->im);
        putchar('\n');
    }
}

static void print_parameters(const struct fragility_result *r) {
    const struct fragility *f = &r->fit;
    const char *unit = r->suite->abscissa_units, *blank = unit[0] ? " " : "";
    if (f->outcome == FRAGILITY_FITTED) {
        study_print_curve(f, unit, &r->suite->view->units);
        study_print_bootstrap(&r->bootstrap, unit);
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

static int count_crossings(const struct fragility_result *r, enum fragility_crossing crossing) {
    int n = 0;
    for (int k = 0; k < r->runs.n_unit; k++) {
        n += r->record[k].crossing == crossing;
    }
    return n;
}

// How many samples have such a crossing, and which ones if it is none.
static void print_crossings(const struct fragility_result *r, enum fragility_crossing crossing,
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

// The counts at each intensity, and what the curve has there.
static int print_levels(const struct fragility_result *r, struct error *e) {
    const struct suite *s = r->suite;
    struct printer t = {.to = stdout};
    printer_add(&t,
                &(struct printer_column){
                    .head = s->im, .unit = s->abscissa_units, .width = 16, .digits = 6},
                1);
    PRINTER_ADD(&t, level_columns);
    if (r->hazard) {
        PRINTER_ADD(&t, of_hazard_level);
    }
    printer_head(&t);
    for (int j = 0; j < r->n_level; j++) {
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
    return printer_end(&t, STATUS_OK, e);
}

int fragility_print_text(const struct fragility_result *r, struct error *e) {
    const struct suite *s = r->suite;
    const char *unit = unit_suffix(s->edp.units), *im_unit = s->abscissa_units;
    int status = STATUS_OK;
    putchar('\n');
    safe_put(stdout, SAFE_TERMINAL, s->edp.text);
    if (!edp_is_collapse(&s->edp)) {
        printf(" > %.6g%s%s%s", r->limit, unit[0] ? " " : "", unit,
               study_print_g(&s->view->units, s->edp.units, r->limit).added);
    }
    safe_line(stdout, "%s%s", s->group[r->group][0] ? ", " : "", s->group[r->group]);
    if ((s->intensity || s->mixed) && r->n_level > LEVELS_MAX) {
        printf("%d intensities from %.6g to %.6g%s%s; --tsv has them all\n", r->n_level,
               r->level[0].intensity, r->level[r->n_level - 1].intensity, im_unit[0] ? " " : "",
               im_unit);
    } else {
        status = print_levels(r, e);
    }
    if (r->method == METHOD_IDA) {
        print_crossings(r, CROSSING_AT, "first exceed the limit between two intensities");
        print_crossings(r, CROSSING_ABOVE,
                        "never exceed it and count as above their highest intensity");
        print_crossings(r, CROSSING_BELOW,
                        "always exceed it and count as below their lowest intensity");
        print_crossings(r, CROSSING_NO_RUNS, "have no runs and are left out");
    } else if (r->method == METHOD_CLOUD) {
        print_cloud(r);
    }
    print_parameters(r);
    return status;
}

void fragility_print_columns(const struct fragility_result *r, struct printer *t) {
    const struct suite *s = r->suite;
    PRINTER_ADD(t, of_limit);
    for (int i = 0; i < s->n_group_sweep; i++) {
        printer_add_sweep(t, s->view->sweep[s->group_sweep[i]]);
    }
    PRINTER_ADD(t, of_level);
    if (r->hazard) {
        PRINTER_ADD(t, of_hazard);
    }
    if (r->method == METHOD_CLOUD) {
        PRINTER_ADD(t, of_cloud);
    }
    if (r->bootstrap.n_draw > 0) {
        study_print_bootstrap_columns(t);
    }
}

// A number of the curve; an empty cell where there is none.
static void print_fitted(struct printer *t, const struct fragility *f, double value) {
    if (f->outcome == FRAGILITY_FITTED && !isnan(value)) {
        printer_number(t, value);
    } else {
        printer_empty(t);
    }
}

static void print_cloud_data(const struct fragility_result *r, struct printer *t) {
    const struct cloud *c = &r->cloud;
    print_fitted(t, &r->fit, c->intercept);
    print_fitted(t, &r->fit, c->slope);
    print_fitted(t, &r->fit, c->scatter);
    printer_whole(t, c->n_collapsed);
    for (int i = 0; i < 2; i++) {
        if (r->fit.mixed) {
            print_fitted(t, &r->fit, r->fit.logit[i]);
        } else {
            printer_empty(t);
        }
    }
}

static void print_level_data(const struct fragility_result *r, const struct fragility_level *l,
                             struct printer *t) {
    const struct suite *s = r->suite;
    const struct fragility *f = &r->fit;
    const bool ida = r->method == METHOD_IDA;
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
}

void fragility_print_data(const struct fragility_result *r, struct printer *t) {
    const struct suite *s = r->suite;
    const struct bootstrap *b = &r->bootstrap;
    for (int j = 0; j < r->n_level; j++) {
        printer_text(t, s->edp.text);
        printer_number(t, r->limit);
        printer_text(t, s->edp.units);
        for (int i = 0; i < s->n_group_sweep; i++) {
            printer_sweep(t, s->view->sweep[s->group_sweep[i]], suite_group_choice(s, r->group, i));
        }
        print_level_data(r, &r->level[j], t);
        if (r->method == METHOD_CLOUD) {
            print_cloud_data(r, t);
        }
        if (b->n_draw > 0) {
            study_print_bootstrap_cells(b, t);
        }
        printer_line(t);
    }
}
