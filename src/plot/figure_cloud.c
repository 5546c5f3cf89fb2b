// SPDX-License-Identifier: GPL-3.0-or-later
// Cloud analysis: the demand of each run over its intensity, and the line of the regression with
// its scatter. Runs that collapsed are at the upper edge.
#include <math.h>

#include "plot/script.h"
#include "plot/study_figure.h"
#include "study/cloud.h"

enum { STEPS = 100 };

// Collapses of a group are so far below those of the group before, over the range of demands.
static const double APART = 0.03;

struct view {
    const struct suite *s;
    struct study_demand demand;
    struct span x, y;                    // of the points, logarithmic
    struct cloud cloud[SCRIPT_COLOURS];  // (n_group)
    int n_collapsed;
};

static int check(const struct subject *p, struct error *e) {
    const struct suite *s = p->suite;
    if (s->point_name && !s->intensity) {
        return error_set(e, STATUS_INPUT, "'%s' is not a sweep of numbers; see --im",
                         s->abscissa->name);
    }
    if (edp_is_collapse(&s->edp)) {
        return error_set(e, STATUS_INPUT, "a collapse has no demand; see fragility");
    }
    if (s->n_group > SCRIPT_COLOURS) {
        return error_set(e, STATUS_INPUT,
                         "%d groups (%s ...) are more than %d; choose with --at, or make samples "
                         "with --over",
                         s->n_group, s->group[0], SCRIPT_COLOURS);
    }
    return STATUS_OK;
}

// Points with logarithms.
static bool is_shown(const struct fragility_run *run) {
    return run->intensity > 0.0 && run->demand > 0.0 && isfinite(run->demand);
}

static void write_group(struct view *v, int g, const struct fragility_runs *runs,
                        struct canvas *c) {
    canvas_block(c, "intensity, demand", "runs%d", g);
    for (int i = 0; i < runs->n; i++) {
        const double y = v->demand.factor * runs->run[i].demand;
        if (is_shown(&runs->run[i])) {
            study_point(c->data, runs->run[i].intensity, y);
            span_add(&v->x, runs->run[i].intensity);
            span_add(&v->y, y);
        }
    }
    canvas_end(c);
    canvas_block(c, "intensity of a run above all values", "collapses%d", g);
    for (int i = 0; i < runs->n; i++) {
        if (isinf(runs->run[i].demand) && runs->run[i].intensity > 0.0) {
            span_add(&v->x, runs->run[i].intensity);
            fprintf(c->data, "%.7g\n", runs->run[i].intensity);
        }
    }
    canvas_end(c);
}

static void write_points(struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    struct fragility_runs runs = {.n = 0};
    if (c->status == STATUS_OK) {
        c->status = fragility_runs_create(s, &runs, c->e);
    }
    for (int g = 0; g < s->n_group && c->status == STATUS_OK; g++) {
        fragility_runs_take(&runs, s, g);
        write_group(v, g, &runs, c);
        c->status = cloud_fit(&runs, NULL, 1.0, false, &v->cloud[g], c->e);
        v->n_collapsed += v->cloud[g].n_collapsed;
    }
    if (!(v->y.low <= v->y.high)) {
        canvas_fail(c, STATUS_INPUT, "no run has a demand > 0 at an intensity > 0");
    }
}

// The line, and one scatter below and above it, in steps that may leave the panel.
static void write_lines(const struct view *v, struct canvas *c) {
    for (int g = 0; g < v->s->n_group; g++) {
        const struct cloud *of = &v->cloud[g];
        canvas_block(c, "intensity, demand, less and more by the scatter", "line%d", g);
        for (int i = 0; i <= STEPS; i++) {
            const double x = v->x.low * pow(v->x.high / v->x.low, (double)i / STEPS);
            const double y = v->demand.factor * exp(of->intercept + of->slope * log(x));
            study_number(c->data, x);
            study_number(c->data, y);
            study_number(c->data, y * exp(-of->scatter));
            study_number(c->data, y * exp(of->scatter));
            fputc('\n', c->data);
        }
        canvas_end(c);
    }
}

static void write_limits(const struct view *v, const struct subject *p, struct canvas *c) {
    canvas_block(c, "intensity, limit", "limits");
    for (int i = 0; i < p->n_limit; i++) {
        study_point(c->data, v->x.low, v->demand.factor * p->limit[i]);
        study_point(c->data, v->x.high, v->demand.factor * p->limit[i]);
        fputc('\n', c->data);
    }
    canvas_end(c);
}

static struct span with_room(struct span s) {
    const double room = pow(s.high / s.low, 0.05) * 1.01;
    return (struct span){s.low / room, s.high * room};
}

static struct style scatter_line(int group) {
    return (struct style){STYLE_LINE, script_colour[group], 1, "(10,6)", 0, 0};
}

static void write_legend(const struct view *v, const struct subject *p, struct canvas *c) {
    struct legend l = {0};
    char text[128];
    for (int g = 0; g < v->s->n_group && v->s->n_group > 1; g++) {
        study_group_text(v->s, g, text, sizeof text);
        legend_add(&l,
                   (struct style){
                       .kind = STYLE_BOTH, .colour = script_colour[g], .point = script_point[g]},
                   "", text);
    }
    if (v->s->n_group == 1) {
        legend_add(&l, panel_line(script_colour[0], 1.5), "regression", "");
        legend_add(&l, scatter_line(0), "plus and minus its scatter", "");
    }
    study_limit_legend(p, &l);
    if (v->n_collapsed > 0) {
        legend_add(&l, panel_points("#000000", POINT_CROSS, 0), "collapsed or failed", "");
    }
    legend_write(&l, c);
}

static void draw_panel(const struct view *v, const struct subject *p, struct canvas *c) {
    const struct suite *s = v->s;
    const bool number = dimension_equal(s->abscissa_dimension, dimension_none);
    const struct axis x = {.name = s->im,
                           .unit = number ? "" : NULL,
                           .dimension = s->abscissa_dimension,
                           .span = with_room(v->x),
                           .kind = AXIS_LOGARITHMIC};
    struct axis y = study_demand_axis(&v->demand, s, v->y);
    y.span = with_room(v->y);
    y.kind = AXIS_LOGARITHMIC;
    study_panel(c, 3.2, &x, &y);
    for (int g = 0; g < s->n_group; g++) {
        panel_series(c, panel_points(script_colour[g], script_point[g], 0), "$runs%d using 1:2", g);
        panel_series(c, panel_line(script_colour[g], 1.5), "$line%d using 1:2", g);
        for (int k = 3; k <= 4 && s->n_group == 1; k++) {
            panel_series(c, scatter_line(g), "$line%d using 1:%d", g, k);
        }
        if (v->cloud[g].n_collapsed > 0) {
            const double at = v->y.high * pow(v->y.low / v->y.high, APART * g);
            panel_series(c, panel_points(script_colour[g], POINT_CROSS, 0),
                         "$collapses%d using 1:(%g)", g, at);
        }
    }
    if (p->n_limit > 0) {
        panel_series(c, panel_line("#000000", 1.5), "$limits using 1:2");
    }
    panel_close(c);
}

static void draw(const struct subject *p, struct canvas *c) {
    const struct suite *s = p->suite;
    struct view v = {.s = s, .x = span_none, .y = span_none};
    study_demand_init(&v.demand, &s->edp);
    write_points(&v, c);
    if (c->status != STATUS_OK) {
        return;
    }
    for (int i = 0; i < p->n_limit; i++) {
        span_add(&v.y, v.demand.factor * p->limit[i]);
    }
    write_lines(&v, c);
    write_limits(&v, p, c);
    const long n = s->n_run - s->n_missing;
    if (s->n_group == 1 && isfinite(v.cloud[0].slope)) {
        study_head(c, s, "%s: %ld runs; slope %.3g, scatter %.3g", v.demand.name, n,
                   v.cloud[0].slope, v.cloud[0].scatter);
    } else {
        study_head(c, s, "%s: %ld runs", v.demand.name, n);
    }
    write_legend(&v, p, c);
    draw_panel(&v, p, c);
}

const struct figure figure_cloud = {
    .name = "cloud",
    .doc = "the demand of each run over its intensity, and the regression of a cloud analysis",
    .of = SUBJECT_STUDY,
    .guess = SUITE_INTENSITY,
    .by_run = true,
    .check = check,
    .draw = draw,
};
