// SPDX-License-Identifier: GPL-3.0-or-later
// Incremental dynamic analysis: one curve for each sample, demand across and intensity upright,
// with the 16, 50 and 84 % of the demand at each intensity (Vamvatsikos and Cornell 2002,
// Earthquake Engineering & Structural Dynamics 31, 491-514). A curve ends with a cross below the
// intensity at which its run failed. Where a run collapsed, its curve goes on from the demand that
// it reached as a flat line to the edge, and ends there.
#include <math.h>

#include "core/arena.h"
#include "core/safe.h"
#include "plot/study_figure.h"

enum { CURVES = 3 };
static const struct {
    double fraction;
    const char *name;
    struct style style;
} curve[CURVES] = {
    {0.84, "84 %", {STYLE_LINE, "#d55e00", 1.8, "(10,6)", 0, 0}},
    {0.50, "50 %", {STYLE_LINE, "#0072b2", 1.8, "solid", 0, 0}},
    {0.16, "16 %", {STYLE_LINE, "#009e73", 1.8, "(10,6)", 0, 0}},
};
static const char record_colour[] = "#a0a0a0";
static const struct style flat_style = {
    .kind = STYLE_POINTS, .colour = "#000000", .point = POINT_DISC};

// How far flat lines go beyond the largest demand, over the range of demands.
static const double FLAT = 0.08;

struct view {
    const struct suite *s;
    struct study_demand demand;
    struct span span;  // of the demand
    bool crosses, flattens;
};

static int check(const struct subject *p, struct error *e) {
    const struct suite *s = p->suite;
    if (!s->abscissa->number || s->n_point < 2) {
        return error_set(e, STATUS_INPUT, "'%s' %s", s->abscissa->name,
                         s->abscissa->number ? "has one value only" : "is not a sweep of numbers");
    }
    if (s->mixed) {
        return error_set(e, STATUS_INPUT,
                         "'%s' is %s, along which other things change, too; "
                         "see response",
                         s->abscissa->name, s->mixed);
    }
    if (s->n_group > 1) {
        return error_set(e, STATUS_INPUT,
                         "the study has other sweeps (%s ...); choose one "
                         "value with --at, or make them samples with --over",
                         s->group[0]);
    }
    return STATUS_OK;
}

// How many points the curve of a sample has: up to its first collapse.
static int points_of(const struct suite *s, int sample) {
    int n = 0;
    while (n < s->n_point && (n == 0 || !suite_collapsed(s, 0, sample, n - 1))) {
        n++;
    }
    return n;
}

// From the demand that a collapsed run reached to the edge of the picture.
static void write_flats(struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    const double edge = v->span.high + FLAT * (v->span.high - v->span.low);
    canvas_block(c, "demand, intensity, of collapses", "flats");
    for (int k = 0; k < s->n_sample; k++) {
        const int last = points_of(s, k) - 1;
        if (suite_collapsed(s, 0, k, last)) {
            study_point(c->data, v->demand.factor * suite_reached(s, 0, k, last), s->point[last]);
            study_point(c->data, edge, s->point[last]);
            fputc('\n', c->data);
            v->flattens = true;
        }
    }
    canvas_end(c);
    if (v->flattens) {
        span_add(&v->span, edge);
    }
}

static void write_samples(struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    canvas_block(c, "demand, intensity; a sample behind the other", "samples");
    for (int k = 0; k < s->n_sample; k++) {
        fputs("# ", c->data);
        safe_put(c->data, SAFE_COMMENT, s->sample[k]);
        fputc('\n', c->data);
        for (int j = 0; j < points_of(s, k); j++) {
            const double x = v->demand.factor * suite_reached(s, 0, k, j);
            study_point(c->data, x, s->point[j]);
            span_add(&v->span, x);
        }
        fputc('\n', c->data);
    }
    canvas_end(c);
    canvas_block(c, "the last point before a failed run", "failures");
    for (int k = 0; k < s->n_sample; k++) {
        for (int j = 1; j < s->n_point; j++) {
            const double before = suite_value(s, 0, k, j - 1);
            if (isfinite(before) && !isfinite(suite_value(s, 0, k, j)) &&
                !suite_collapsed(s, 0, k, j)) {
                study_point(c->data, v->demand.factor * before, s->point[j - 1]);
                v->crosses = true;
            }
        }
    }
    canvas_end(c);
}

static void write_hit(const struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    canvas_block(c, "demand, intensity, of floors that were hit", "hit");
    for (int i = 0; i < s->n_sample * s->n_point; i++) {
        const int k = i / s->n_point, j = i % s->n_point;
        if (suite_hit(s, 0, k, j)) {
            study_point(c->data, v->demand.factor * suite_value(s, 0, k, j), s->point[j]);
        }
    }
    canvas_end(c);
}

static void write_percentiles(struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    double *work = arena_alloc(s->arena, (size_t)s->n_sample, sizeof *work);
    if (!work) {
        c->status = error_no_memory(c->e);
        return;
    }
    canvas_block(c, "intensity, demand at 84, 50 and 16 %", "percentiles");
    for (int j = 0; j < s->n_point; j++) {
        study_number(c->data, s->point[j]);
        for (int i = 0; i < CURVES; i++) {
            study_number(c->data,
                         v->demand.factor * suite_percentile(s, 0, j, curve[i].fraction, work));
        }
        fputc('\n', c->data);
    }
    canvas_end(c);
}

static void write_legend(const struct view *v, const struct subject *p, struct canvas *c) {
    struct legend l = {0};
    char text[128];
    for (int i = 0; v->s->n_sample > 1 && i < CURVES; i++) {
        legend_add(&l, curve[i].style, curve[i].name, "");
    }
    snprintf(text, sizeof text, "each %s", v->s->over[0] ? v->s->over : "run");
    legend_add(&l, panel_line(record_colour, 0), text, "");
    study_limit_legend(p, &l);
    if (v->crosses) {
        legend_add(&l, panel_points("#000000", POINT_CROSS, 0), "the next run failed", "");
    }
    if (v->flattens) {
        legend_add(&l, flat_style, "collapse", "");
    }
    study_hit_legend(v->s, &l);
    legend_write(&l, c);
}

static void draw_panel(const struct view *v, const struct subject *p, struct canvas *c) {
    const struct axis x = study_demand_axis(&v->demand, v->s, v->span);
    const struct axis y = study_abscissa_axis(v->s);
    study_panel(c, 3.2, &x, &y);
    for (int i = 0; i < p->n_limit; i++) {
        panel_upright(c, v->demand.factor * p->limit[i], panel_line("#000000", 1.5));
    }
    panel_series(c, panel_line(record_colour, 0.8), "$samples using 1:2");
    for (int i = CURVES - 1; v->s->n_sample > 1 && i >= 0; i--) {
        panel_series(c, curve[i].style, "$percentiles using %d:1", i + 2);
    }
    if (v->crosses) {
        panel_series(c, panel_points("#000000", POINT_CROSS, 0), "$failures using 1:2");
    }
    if (v->flattens) {
        panel_series(c, panel_line(record_colour, 0.8), "$flats using 1:2");
        panel_series(c, flat_style, "$flats using 1:2 every ::0::0");
    }
    study_hit_series(v->s, c);
    panel_close(c);
}

static void draw(const struct subject *p, struct canvas *c) {
    const struct suite *s = p->suite;
    struct view v = {.s = s, .span = span_none};
    study_demand_init(&v.demand, &s->edp);
    write_samples(&v, c);
    write_flats(&v, c);
    if (s->n_hit > 0) {
        write_hit(&v, c);
    }
    write_percentiles(&v, c);
    for (int i = 0; i < p->n_limit; i++) {
        span_add(&v.span, v.demand.factor * p->limit[i]);
    }
    study_head(c, s, "%s, %s of each run", s->edp.quantity->doc,
               s->edp.quantity->reduction == EDP_SUM ? "all" : "the largest");
    write_legend(&v, p, c);
    draw_panel(&v, p, c);
}

const struct figure figure_ida = {
    .name = "ida",
    .doc = "incremental dynamic analysis: a curve for each record, and 16, 50 and 84 %",
    .of = SUBJECT_STUDY,
    .guess = SUITE_INTENSITY,
    .check = check,
    .draw = draw,
};
