// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/ida_print.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "command/study_print.h"
#include "core/safe.h"
#include "study/percentile.h"

// The run with these values of all sweeps but the intensity: sample `sample` of group `group`.
static long run_of(const struct ida_print *p, int group, int sample) {
    const struct study_view *v = p->view;
    int choice[STUDY_SWEEPS_MAX] = {0};
    for (int i = v->n_sweep - 1; i >= 0; i--) {
        int *rest = p->roles->role[i] == ROLE_SAMPLE  ? &sample
                    : p->roles->role[i] == ROLE_GROUP ? &group
                                                      : NULL;
        if (rest) {
            choice[i] = *rest % v->sweep[i]->n;
            *rest /= v->sweep[i]->n;
        }
    }
    long run = 0;
    for (int i = 0; i < v->n_sweep; i++) {
        run = i == p->roles->abscissa ? run : run * v->sweep[i]->n + choice[i];
    }
    return run;
}

static void add_sweeps(struct ida_print *p) {
    for (int i = 0; i < p->view->n_sweep; i++) {
        if (i != p->roles->abscissa) {
            printer_show_sweep(&p->table, p->view->sweep[i]);
        }
    }
}

static void print_sweeps(struct ida_print *p, long run) {
    int choice[STUDY_SWEEPS_MAX];
    plan_choose(&p->found->at.plan, run, choice);
    for (int i = 0; i < p->view->n_sweep; i++) {
        if (i != p->roles->abscissa) {
            printer_sweep(&p->table, p->view->sweep[i], choice[i]);
        }
    }
}

static const char *outcome_of(const struct ida_print *p, const struct capacity *c) {
    static const char *const text[] = {[CROSSING_AT] = "found",
                                       [CROSSING_ABOVE] = "never exceeded",
                                       [CROSSING_BELOW] = "always exceeded",
                                       [CROSSING_NO_RUNS] = "failed"};
    return ida_print_is_short(p->request, c) ? "too few runs" : text[c->crossing];
}

bool ida_print_is_short(const struct capacity_request *q, const struct capacity *c) {
    return (c->crossing == CROSSING_AT && !capacity_is_found(q, c)) ||
           (c->crossing == CROSSING_ABOVE && c->below < q->to);
}

// The curve of a group.
struct group_curve {
    struct fragility fit;
    struct bootstrap bootstrap;  // n_draw 0: none
    double rate;                 // of exceedance in a year; NAN: there is none
};

// Fits the samples of a group.
static int fit_group(const struct ida_print *p, int group, struct group_curve *out,
                     struct error *e) {
    const int n = roles_count(p->view, p->roles, ROLE_SAMPLE);
    struct fragility_record *record = malloc(2 * (size_t)n * sizeof *record);
    if (!record) {
        return error_no_memory(e);
    }
    for (int k = 0; k < n; k++) {
        record[k] = capacity_record(&p->found->each[run_of(p, group, k)]);
    }
    struct bootstrap_records records = {record, n, record + n};
    const struct bootstrap_request request = {.n_unit = n,
                                              .n_draw = p->n_bootstrap,
                                              .seed = p->seed,
                                              .fit = bootstrap_fit_records,
                                              .context = &records};
    int status = fragility_fit_records(record, n, &out->fit, e);
    if (status == STATUS_OK && p->n_bootstrap > 0) {
        status = bootstrap_run(&request, &out->bootstrap, e);
    }
    if (status == STATUS_OK) {
        out->rate = study_print_find_rate(p->hazard, &out->fit, p->request->unit);
    }
    free(record);
    return status;
}

static void print_sample(struct ida_print *p, long run, const struct group_curve *of) {
    const struct capacity *c = &p->found->each[run];
    struct printer *t = &p->table;
    print_sweeps(p, run);
    printer_number(t, c->below);
    printer_number(t, c->above);
    printer_number(t, c->crossing_at);
    printer_number(t, c->value);
    printer_whole(t, c->n_point);
    printer_text(t, outcome_of(p, c));
    printer_text(t, p->request->edp.text);
    printer_number(t, p->request->limit);
    printer_number(t, of->fit.median);
    printer_number(t, of->fit.dispersion);
    if (p->hazard) {
        printer_number(t, of->rate);
    }
    if (p->n_bootstrap > 0) {
        study_print_bootstrap_cells(&of->bootstrap, t);
    }
    printer_line(t);
}

static void print_fit(const struct ida_print *p, int group, const struct group_curve *of) {
    const struct fragility *f = &of->fit;
    const char *comma = "";
    int choice[STUDY_SWEEPS_MAX];
    plan_choose(&p->found->at.plan, run_of(p, group, 0), choice);
    for (int i = 0; i < p->view->n_sweep; i++) {
        const struct sweep *s = p->view->sweep[i];
        if (p->roles->role[i] == ROLE_GROUP) {
            printf("%s", comma);
            safe_put(stdout, SAFE_TERMINAL, s->name);
            printf(s->number ? " = %.6g" : " = ", s->number ? s->number[choice[i]] : 0.0);
            safe_put(stdout, SAFE_TERMINAL, s->number ? "" : s->label[choice[i]]);
            comma = ", ";
        }
    }
    printf("%s", comma[0] ? ": " : "");
    if (f->outcome != FRAGILITY_FITTED) {
        printf("no curve: %s\n", fragility_reason(f));
        return;
    }
    study_print_curve(f, p->request->unit, &p->view->units);
    study_print_bootstrap(&of->bootstrap, p->request->unit);
    if (p->hazard) {
        study_print_rate(of->rate);
    }
}

static int print_groups(struct ida_print *p, int n_group, struct group_curve *curve,
                        struct error *e) {
    const char *im = p->view->sweep[p->roles->abscissa]->name;
    const char *unit = p->request->unit, *edp_unit = unit_suffix(p->request->edp.units);
    const int n_sample = roles_count(p->view, p->roles, ROLE_SAMPLE);
    struct printer_column columns[] = {
        {.head = "below", .key = "below", .unit = unit, .width = 12, .digits = 5},
        {.head = "above", .key = "above", .unit = unit, .width = 12, .digits = 5},
        {.head = "capacity", .key = "capacity", .unit = unit, .width = 12, .digits = 5},
        {.head = "demand", .key = "demand", .unit = edp_unit, .width = 12, .digits = 5},
        {.head = "runs", .key = "runs", .width = 6},
        {.head = "outcome", .key = "outcome", .width = -16},
        COLUMN_DATA("edp"),
        {.key = "limit", .unit = edp_unit},
        {.key = "median", .unit = unit},
        {.key = "dispersion"}};
    add_sweeps(p);
    PRINTER_ADD(&p->table, columns);
    if (p->hazard) {
        printer_add(&p->table, &(struct printer_column)COLUMN_DATA("annual_rate"), 1);
    }
    if (p->n_bootstrap > 0) {
        study_print_bootstrap_columns(&p->table);
    }
    if (p->table.form == FORM_TEXT) {
        safe_line(stdout, "intensities of %s at which %s first exceeds its limit", im,
                  p->request->edp.text);
    }
    printer_head(&p->table);
    int status = STATUS_OK;
    for (int g = 0; g < n_group && status == STATUS_OK; g++) {
        status = fit_group(p, g, &curve[g], e);
        for (int k = 0; k < n_sample && status == STATUS_OK; k++) {
            print_sample(p, run_of(p, g, k), &curve[g]);
        }
    }
    status = printer_end(&p->table, status, e);
    for (int g = 0; g < n_group && status == STATUS_OK && p->table.form == FORM_TEXT; g++) {
        print_fit(p, g, &curve[g]);
    }
    return status;
}

int ida_print_samples(struct ida_print *p, struct error *e) {
    const int n_group = roles_count(p->view, p->roles, ROLE_GROUP);
    struct group_curve *curve = calloc((size_t)n_group, sizeof *curve);
    if (!curve) {
        return error_no_memory(e);
    }
    const int status = print_groups(p, n_group, curve, e);
    free(curve);
    return status;
}

int ida_print_points(struct ida_print *p, struct error *e) {
    const char *unit = p->request->unit, *edp_unit = unit_suffix(p->request->edp.units);
    struct printer_column columns[] = {
        {.head = p->request->intensity,
         .key = p->request->intensity,
         .unit = unit,
         .width = 16,
         .digits = 6},
        {.head = "demand", .key = "demand", .unit = edp_unit, .width = 16, .digits = 6},
        {.head = "exceeded", .key = "exceeded", .width = 10}};
    add_sweeps(p);
    PRINTER_ADD(&p->table, columns);
    printer_head(&p->table);
    for (long run = 0; run < p->found->n; run++) {
        const struct capacity *c = &p->found->each[run];
        for (int i = 0; i < c->n_point; i++) {
            print_sweeps(p, run);
            printer_number(&p->table, c->point[i].intensity);
            printer_number(&p->table, c->point[i].value);
            printer_whole(&p->table, c->point[i].exceeded);
            printer_line(&p->table);
        }
    }
    return printer_end(&p->table, STATUS_OK, e);
}

// The intensities at which the samples of a group reach a demand, sorted: n of those that did not
// fail.
static int reach(const struct ida_print *p, int group, double demand, double *intensity) {
    const int n_sample = roles_count(p->view, p->roles, ROLE_SAMPLE);
    int n = 0;
    for (int k = 0; k < n_sample; k++) {
        const struct capacity *c = &p->found->each[run_of(p, group, k)];
        if (c->crossing != CROSSING_NO_RUNS) {
            intensity[n++] = capacity_curve_reaches(c, demand, p->request->curve);
        }
    }
    gsl_sort(intensity, 1, (size_t)n);
    return n;
}

static void print_curve(struct ida_print *p, int group, int n_demand, double *intensity) {
    static const double fraction[] = {0.16, 0.50, 0.84};
    int choice[STUDY_SWEEPS_MAX];
    plan_choose(&p->found->at.plan, run_of(p, group, 0), choice);
    for (int k = 1; k <= n_demand; k++) {
        const double demand = p->request->limit * k / n_demand;
        const int n = reach(p, group, demand, intensity);
        for (int i = 0; i < p->view->n_sweep; i++) {
            if (p->roles->role[i] == ROLE_GROUP) {
                printer_sweep(&p->table, p->view->sweep[i], choice[i]);
            }
        }
        printer_number(&p->table, demand);
        for (int i = 0; i < 3; i++) {
            const double x =
                n > 0 ? percentile_sorted(intensity, (size_t)n, fraction[i]) : (double)NAN;
            printer_number(&p->table, isinf(x) ? (double)NAN : x);
        }
        printer_line(&p->table);
    }
}

int ida_print_curves(struct ida_print *p, int n, struct error *e) {
    const char *unit = p->request->unit, *edp_unit = unit_suffix(p->request->edp.units);
    const int n_group = roles_count(p->view, p->roles, ROLE_GROUP);
    const size_t n_sample = (size_t)roles_count(p->view, p->roles, ROLE_SAMPLE);
    double *intensity = malloc(n_sample * sizeof *intensity);
    struct printer_column columns[] = {
        {.head = "demand", .key = "demand", .unit = edp_unit, .width = 14, .digits = 5},
        {.head = "16 %", .key = "intensity_16", .unit = unit, .width = 12, .digits = 5},
        {.head = "50 %", .key = "intensity_50", .unit = unit, .width = 12, .digits = 5},
        {.head = "84 %", .key = "intensity_84", .unit = unit, .width = 12, .digits = 5}};
    if (!intensity) {
        return error_no_memory(e);
    }
    for (int i = 0; i < p->view->n_sweep; i++) {
        if (p->roles->role[i] == ROLE_GROUP) {
            printer_show_sweep(&p->table, p->view->sweep[i]);
        }
    }
    PRINTER_ADD(&p->table, columns);
    if (p->table.form == FORM_TEXT) {
        safe_line(stdout, "intensities of %s at which records reach %s", p->request->intensity,
                  p->request->edp.text);
    }
    printer_head(&p->table);
    for (int g = 0; g < n_group; g++) {
        print_curve(p, g, n, intensity);
    }
    free(intensity);
    return printer_end(&p->table, STATUS_OK, e);
}
