// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/study_figure.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "core/safe.h"
#include "plot/script.h"

void study_demand_init(struct study_demand *d, const struct edp *edp) {
    const bool ratio = edp->quantity->divisor != NULL;
    const bool count = !ratio && dimension_equal(edp->dimension, dimension_none);
    *d = (struct study_demand){.factor = ratio ? 100.0 : 1.0,
                               .unit = ratio   ? "%"
                                       : count ? ""
                                               : NULL};
    const char *place = strchr(edp->text, ':');
    snprintf(d->name, sizeof d->name, "%s%s%s", edp->quantity->name, place ? ", " : "",
             place ? place + 1 : "");
    for (char *at = d->name; *at && *at != ','; at++) {
        *at = *at == '-' ? ' ' : *at;
    }
}

struct axis study_demand_axis(const struct study_demand *d, const struct suite *s,
                              struct span span) {
    return (struct axis){.name = d->name,
                         .unit = d->unit,
                         .dimension = s->edp.dimension,
                         .span = span_with_room(span, span.low < 0 ? (double)NAN : 0)};
}

// An axis of an intensity begins at 0 where no more than this share of it has no values.
static const double EMPTY = 0.3;

static bool is_geometric(const struct suite *s) {
    const double *x = s->point;
    const int n = s->n_point;
    bool even = n > 2 && x[0] > 0 && x[n - 1] >= 10 * x[0];
    for (int i = 1; even && i < n; i++) {
        even = fabs(log(x[i] / x[i - 1]) - log(x[1] / x[0])) < 1e-6;
    }
    return even;
}

struct axis study_abscissa_axis(const struct suite *s) {
    const bool number = dimension_equal(s->abscissa_dimension, dimension_none);
    struct axis axis = {.name = s->abscissa->name,
                        .unit = number ? "" : NULL,
                        .dimension = s->abscissa_dimension,
                        .span = span_none};
    for (int i = 0; i < s->n_point; i++) {
        span_add(&axis.span, s->point[i]);
    }
    if (s->abscissa->number && is_geometric(s) && axis.span.low > 0) {
        const double room = pow(axis.span.high, 0.03) / pow(axis.span.low, 0.03);
        axis.kind = AXIS_LOGARITHMIC;
        axis.span = (struct span){axis.span.low / room, axis.span.high * room};
        return axis;
    }
    const bool near = axis.span.low >= 0 && axis.span.low <= EMPTY * axis.span.high;
    axis.span = span_with_room(axis.span, s->is_intensity && near ? 0 : (double)NAN);
    return axis;
}

void study_head(struct canvas *c, const struct suite *s, const char *what, ...) {
    char text[512], shown[256], failed[128] = "", hit[96] = "";
    va_list list;
    va_start(list, what);
    vsnprintf(shown, sizeof shown, what, list);
    va_end(list);
    if (s->n_failed > 0) {
        snprintf(failed, sizeof failed, "%ld of %ld runs failed, %s; ", s->n_failed, s->n_run,
                 s->rule == SUITE_FAILED_ABOVE ? "counted above" : "left out");
    }
    if (s->n_hit > 0) {
        snprintf(hit, sizeof hit, "; in %ld of %ld runs of a %s", s->n_hit, s->n_run,
                 report_hit_name);
    }
    snprintf(text, sizeof text, "%s%s%s%s%s", failed, shown, hit, s->fixed[0] ? "; " : "",
             s->fixed);
    script_raise(text);
    canvas_head(c, s->view->title[0] ? s->view->title : s->view->path, "%s", text);
}

void study_hit_legend(const struct suite *s, struct legend *l) {
    if (s->n_hit > 0) {
        legend_add(l, panel_points("#808080", POINT_RING, 2.8), report_hit_name, "");
    }
}

void study_hit_series(const struct suite *s, struct canvas *c) {
    if (s->n_hit > 0) {
        panel_series(c, panel_points("#808080", POINT_RING, 2.8), "$hit using 1:2");
    }
}

void study_group_text(const struct suite *s, int group, char *text, size_t size) {
    assert(group >= 0 && group < s->n_group && size > 0);
    snprintf(text, size, "%s", s->group[group]);
    script_raise(text);
}

void study_limit_legend(const struct subject *p, struct legend *l) {
    if (p->n_limit > 0) {
        legend_add(l, panel_line("#000000", 0), p->n_limit > 1 ? "limits" : "limit", "");
    }
}

void study_limit_text(const struct study_demand *d, const struct suite *s, double limit, char *text,
                      size_t size) {
    char number[32], unit[64];
    script_number(d->factor * limit, number, sizeof number);
    script_unit(&s->view->units, s->edp.dimension, unit, sizeof unit);
    const char *shown = d->unit ? d->unit : unit;
    snprintf(text, size, "%s%s%s", number, shown[0] ? " " : "", shown);
}

static const double LEFT = 6.5, RIGHT = 0.9;  // [em] beside the panel

double study_panel_width(const struct canvas *c) {
    return c->area.right - c->area.left - LEFT - RIGHT;
}

void study_panel_in(struct canvas *c, struct area a, const struct axis *x, const struct axis *y) {
    struct panel p = {.area = a, .x = *x, .y = *y};
    p.y.name = NULL;
    panel_open(c, &p);
    p.area.left -= 0.6;
    canvas_upright(c, p.area, y);
}

void study_panel(struct canvas *c, double bottom, const struct axis *x, const struct axis *y) {
    study_panel_in(c, canvas_inset(c->area, LEFT, RIGHT, bottom, 0.7), x, y);
}

void study_foot(const struct canvas *c, const char *text) {
    const struct area a = canvas_inset(c->area, LEFT, RIGHT, 0, 0);
    char shown[256];
    script_shorten(text, a.right - a.left, shown, sizeof shown);
    script_raise(shown);
    fprintf(c->to, "set label ");
    safe_put(c->to, SAFE_GNUPLOT, shown);
    canvas_place(c, (a.left + a.right) / 2, a.bottom + 0.7);
    fprintf(c->to, " center\n");
}

void study_number(FILE *to, double value) {
    if (isfinite(value)) {
        fprintf(to, " %.7g", value);
    } else {
        fputs(" NaN", to);
    }
}

void study_point(FILE *to, double x, double y) {
    study_number(to, x);
    study_number(to, y);
    fputc('\n', to);
}
