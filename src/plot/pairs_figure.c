// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>

#include "core/safe.h"
#include "plot/pictures.h"
#include "plot/script.h"
#include "plot/study_figure.h"

enum { POINTS_MAX = 4000 };          // more of them are one blot, and a large file
static const double LOG_FROM = 5.0;  // ratios over a wider range are on a logarithmic axis
static const char line_colour[] = "#808080";

struct pairs_spans {
    struct span value, ratio, at;
};

static void pairs_data(const struct pairs_figure *f, const struct study_demand *d,
                       struct pairs_spans *s, struct canvas *c) {
    FILE *to = c->data;
    const long step = (f->n + POINTS_MAX - 1) / POINTS_MAX;
    canvas_block(c, "demand of the second study, of the first one, ratio, intensity", "pairs");
    for (long i = 0; i < f->n; i += step) {
        const double a = d->factor * f->value[0][i], b = d->factor * f->value[1][i];
        const double ratio = b != 0.0 ? a / b : NAN;
        span_add(&s->value, a);
        span_add(&s->value, b);
        span_add(&s->ratio, ratio);
        study_number(to, b);
        study_number(to, a);
        study_number(to, ratio);
        study_number(to, f->at ? f->at[i] : NAN);
        fputc('\n', to);
        if (f->at) {
            span_add(&s->at, f->at[i]);
        }
    }
    canvas_end(c);
    span_add(&s->ratio, 1.0);
    s->value = span_with_room(s->value, s->value.low < 0.0 ? (double)NAN : 0.0);
    s->at = span_with_room(s->at, NAN);
    canvas_block(c, "line of equality", "equal");
    study_point(to, s->value.low, s->value.low);
    study_point(to, s->value.high, s->value.high);
    canvas_end(c);
    canvas_block(c, "ratio of 1", "one");
    study_point(to, s->at.low, 1.0);
    study_point(to, s->at.high, 1.0);
    canvas_end(c);
}

// One study against the other, with the line of equality.
static void pairs_scatter(const struct pairs_figure *f, const struct study_demand *d,
                          const struct pairs_spans *s, struct canvas *c) {
    char name[2][128];
    struct axis axis[2];
    for (int i = 0; i < 2; i++) {
        snprintf(name[i], sizeof name[i], "%s, %s", d->name, f->study[i]);
        axis[i] = (struct axis){.name = name[i],
                                .brief = f->study[i],
                                .unit = d->unit,
                                .dimension = f->edp->dimension,
                                .span = s->value};
    }
    const struct area a = canvas_part(c, 0, f->at ? 0.5 : 1, 0, 1);
    study_panel_in(c, canvas_inset(a, 0, f->at ? 1.5 : 0.5, 3.2, 0.7), &axis[1], &axis[0]);
    panel_series(c, panel_line(line_colour, 0), "$equal using 1:2");
    panel_series(c, panel_points(script_colour[0], POINT_DISC, 0.8), "$pairs using 1:2");
    panel_close(c);
}

// The ratio over the intensity.
static void pairs_ratio(const struct pairs_figure *f, const struct pairs_spans *s,
                        struct canvas *c) {
    const bool is_number = dimension_equal(f->at_dimension, dimension_none);
    const bool wide = s->ratio.low > 0.0 && s->ratio.high > LOG_FROM * s->ratio.low;
    struct axis ratio = {.name = "ratio", .unit = "", .span = span_with_room(s->ratio, NAN)};
    if (wide) {
        ratio.kind = AXIS_LOGARITHMIC;
        ratio.span = (struct span){s->ratio.low / 1.1, s->ratio.high * 1.1};
    }
    const struct axis at = {.name = f->at_name,
                            .unit = is_number ? "" : NULL,
                            .dimension = f->at_dimension,
                            .span = s->at};
    study_panel_in(c, canvas_inset(canvas_part(c, 0.5, 1, 0, 1), 4.5, 0.5, 3.2, 0.7), &at, &ratio);
    panel_series(c, panel_line(line_colour, 0), "$one using 1:2");
    panel_series(c, panel_points(script_colour[0], POINT_DISC, 0.8), "$pairs using 4:3");
    panel_close(c);
}

int pairs_figure_write(const struct pairs_figure *f, const struct figure_files *to,
                       struct error *e) {
    const struct figure_head head = {.name = "compare",
                                     .doc = "a study against another one",
                                     .version = f->version,
                                     .units = f->units};
    struct pairs_spans spans = {span_none, span_none, span_none};
    struct study_demand demand;
    struct canvas c;
    study_demand_init(&demand, f->edp);
    figure_open(&head, to, &c, e);
    pairs_data(f, &demand, &spans, &c);
    canvas_head(&c, f->title, "%s", f->subtitle);
    c.area.left += 6.5;
    pairs_scatter(f, &demand, &spans, &c);
    if (f->at) {
        pairs_ratio(f, &spans, &c);
    }
    return figure_close(&c);
}
