// SPDX-License-Identifier: GPL-3.0-or-later
// Fragility: the share of the samples that exceed a limit at each intensity, and the lognormal
// curve of largest likelihood through the shares, for each limit and group.
#include <math.h>

#include "core/arena.h"
#include "plot/script.h"
#include "plot/study_figure.h"
#include "study/fragility_runs.h"

enum { STEPS = 200 };

struct view {
    const struct subject *p;
    struct study_demand demand;
    struct axis x;
    struct fragility fit[SCRIPT_COLOURS];
    int n;  // curves: limits times groups
};

static int check(const struct subject *p, struct error *e) {
    const struct suite *s = p->suite;
    if (s->point_name) {
        return error_set(e, STATUS_INPUT, "'%s' is not a sweep of numbers", s->abscissa->name);
    }
    if (p->n_limit == 0) {
        return error_set(e, STATUS_INPUT, "it needs --limit VALUE");
    }
    if (p->n_limit * s->n_group > SCRIPT_COLOURS) {
        return error_set(e, STATUS_INPUT,
                         "%d limits and %d groups (%s ...) make more "
                         "than %d curves; choose with --at, or make samples with --over",
                         p->n_limit, s->n_group, s->group[0], SCRIPT_COLOURS);
    }
    return STATUS_OK;
}

static double limit_of(const struct view *v, int i) {
    return v->p->limit[i / v->p->suite->n_group];
}

static void write_counts(struct view *v, struct canvas *c) {
    const struct suite *s = v->p->suite;
    struct fragility_runs runs;
    if (c->status != STATUS_OK) {
        return;
    }
    c->status = fragility_runs_create(s, &runs, c->e);
    struct fragility_level *level = arena_alloc(s->arena, (size_t)runs.n, sizeof *level);
    if (!level) {
        c->status = error_no_memory(c->e);
        return;
    }
    for (int i = 0; i < v->n && c->status == STATUS_OK; i++) {
        fragility_runs_take(&runs, s, i % s->n_group);
        const int n_level = fragility_runs_count(&runs, limit_of(v, i), NULL, level);
        canvas_block(c, "intensity, share above the limit, runs", "counts%d", i);
        for (int j = 0; j < n_level; j++) {
            const int n = level[j].n;
            study_number(c->data, level[j].intensity);
            study_number(c->data, n > 0 ? (double)level[j].exceeded / n : (double)NAN);
            fprintf(c->data, " %d\n", n);
        }
        canvas_end(c);
        c->status = fragility_fit(level, n_level, &v->fit[i], c->e);
    }
}

// Where shares coincide the later mark lies on the earlier ones, which are larger.
static double mark_size(const struct view *v, int curve) {
    return 1.5 + 0.6 * (v->n - 1 - curve);
}

static void write_legend(const struct view *v, struct canvas *c) {
    const struct suite *s = v->p->suite;
    struct legend l = {0};
    char limit[96], group[128], text[256];
    for (int i = 0; i < v->n; i++) {
        const bool fitted = v->fit[i].outcome == FRAGILITY_FITTED;
        study_group_text(s, i % s->n_group, group, sizeof group);
        study_limit_text(&v->demand, s, limit_of(v, i), limit, sizeof limit);
        snprintf(text, sizeof text, "%s%s%s%s%s", group, group[0] && v->p->n_limit > 1 ? ", " : "",
                 group[0] && v->p->n_limit == 1 ? "" : "> ",
                 group[0] && v->p->n_limit == 1 ? "" : limit, fitted ? "" : " (no curve)");
        legend_add(&l,
                   (struct style){.kind = fitted ? STYLE_LINE : STYLE_POINTS,
                                  .colour = script_colour[i],
                                  .size = mark_size(v, i),
                                  .point = script_point[i]},
                   "", text);
    }
    legend_write(&l, c);
}

// The fitted curves, along the axis as it is drawn.
static void write_curves(const struct view *v, struct canvas *c) {
    const struct span *x = &v->x.span;
    const bool logarithmic = v->x.kind == AXIS_LOGARITHMIC;
    for (int i = 0; i < v->n; i++) {
        if (v->fit[i].outcome != FRAGILITY_FITTED) {
            continue;
        }
        canvas_block(c, "intensity, probability", "curve%d", i);
        for (int k = 0; k <= STEPS; k++) {
            const double t = (double)k / STEPS;
            const double at =
                logarithmic ? x->low * pow(x->high / x->low, t) : x->low + t * (x->high - x->low);
            const double value = at > 0 ? fragility_probability(&v->fit[i], at) : 0;
            fprintf(c->data, "%.7g %.7g\n", at, value);
        }
        canvas_end(c);
    }
}

static void draw(const struct subject *p, struct canvas *c) {
    const struct suite *s = p->suite;
    struct view v = {.p = p, .x = study_abscissa_axis(s), .n = p->n_limit * s->n_group};
    study_demand_init(&v.demand, &s->edp);
    write_counts(&v, c);
    write_curves(&v, c);
    char limit[96];
    study_limit_text(&v.demand, s, p->limit[0], limit, sizeof limit);
    const bool collapse = edp_is_collapse(&s->edp);
    study_head(c, s, "%s%s%s: shares of %d run%s, and lognormal curves", v.demand.name,
               collapse ? "" : " > ",
               collapse         ? ""
               : p->n_limit > 1 ? "limit"
                                : limit,
               s->n_sample, s->n_sample == 1 ? "" : "s");
    write_legend(&v, c);
    const struct axis y = {
        .name = "probability of exceedance", .unit = "", .span = {0, 1.03}, .step = 0.2};
    study_panel(c, 3.2, &v.x, &y);
    for (int i = 0; i < v.n; i++) {
        panel_series(c, panel_points(script_colour[i], script_point[i], mark_size(&v, i)),
                     "$counts%d using 1:2", i);
        if (v.fit[i].outcome == FRAGILITY_FITTED) {
            panel_series(c, panel_line(script_colour[i], 1.5), "$curve%d using 1:2", i);
        }
    }
    panel_close(c);
}

const struct figure figure_fragility = {
    .name = "fragility",
    .doc = "shares of runs above --limit, and lognormal curves",
    .of = SUBJECT_STUDY,
    .guess = SUITE_INTENSITY,
    .check = check,
    .draw = draw,
};
