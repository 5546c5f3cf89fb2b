// SPDX-License-Identifier: GPL-3.0-or-later
// A demand against any swept parameter: the median over the samples with the band from 16 to 84 %,
// or a line for each value of the other sweeps. Against texts, random parameters and what
// goes together, points: nothing lies between them.
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/safe.h"
#include "plot/script.h"
#include "plot/study_figure.h"

static const double name_width = 10.5;  // of a text at the axis [em]
static const char band_colour[] = "#cfe3f1";

struct view {
    const struct suite *s;
    struct study_demand demand;
    struct span span;
    bool band;
    double *work;  // (n_sample) scratch
};

static bool has_points(const struct suite *s) {
    return s->point_name || s->mixed;
}

static int check(const struct subject *p, struct error *e) {
    const struct suite *s = p->suite;
    if (p->n_limit > 0) {
        return error_set(e, STATUS_INPUT, "it shows no limit; --limit is for fragility and ida");
    }
    if (s->n_group <= SCRIPT_COLOURS) {
        return STATUS_OK;
    }
    return error_set(e, STATUS_INPUT,
                     "the values of the other sweeps (%s ...) make %d "
                     "curves, more than %d; choose with --at, or make samples with --over",
                     s->group[0], s->n_group, SCRIPT_COLOURS);
}

static void write_data(struct view *v, FILE *to) {
    static const double fraction[] = {0.5, 0.16, 0.84};
    const struct suite *s = v->s;
    for (int g = 0; g < s->n_group; g++) {
        fprintf(to, "$group%d << EOD\n# ", g);
        safe_put(to, SAFE_COMMENT, s->abscissa->name);
        fprintf(to, ", demand at 50, 16 and 84 %%; ");
        safe_put(to, SAFE_COMMENT, s->group[g]);
        fputc('\n', to);
        for (int j = 0; j < s->n_point; j++) {
            study_number(to, s->point[j]);
            for (int i = 0; i < 3; i++) {
                const double x = v->demand.factor * suite_percentile(s, g, j, fraction[i], v->work);
                study_number(to, x);
                if (i == 0 || v->band) {
                    span_add(&v->span, x);
                }
            }
            fputc('\n', to);
        }
        fprintf(to, "EOD\n");
    }
}

// The medians at which a sample is the acceleration of a floor that was hit.
static void write_hit(const struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    canvas_block(c, "parameter, median, where floors were hit", "hit");
    for (int i = 0; i < s->n_group * s->n_point; i++) {
        const int g = i / s->n_point, j = i % s->n_point;
        bool hit = false;
        for (int k = 0; k < s->n_sample; k++) {
            hit |= suite_hit(s, g, k, j);
        }
        if (hit) {
            study_point(c->data, s->point[j],
                        v->demand.factor * suite_percentile(s, g, j, 0.5, v->work));
        }
    }
    canvas_end(c);
}

static void write_legend(const struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    const bool points = has_points(s);
    struct style mark = {.kind = points ? STYLE_POINTS : STYLE_LINE};
    struct legend l = {0};
    char text[128] = "median";
    for (int g = 0; g < s->n_group && (v->band || s->n_group > 1); g++) {
        if (s->n_group > 1) {
            study_group_text(s, g, text, sizeof text);
        }
        mark.colour = script_colour[g];
        mark.point = script_point[g];
        legend_add(&l, mark, "", text);
    }
    if (v->band) {
        legend_add(&l,
                   (struct style){.kind = points ? STYLE_LINE : STYLE_AREA,
                                  .colour = points ? script_colour[0] : band_colour},
                   "16 to 84 %", "");
    }
    study_hit_legend(s, &l);
    legend_write(&l, c);
}

static double widest_text(const struct suite *s) {
    double most = 0;
    for (int i = 0; i < s->n_point; i++) {
        most = fmax(most, script_width(s->point_name[i]));
    }
    return most;
}

// True if the texts find room beside each other within `width` em.
static bool texts_fit(const struct suite *s, double width) {
    return widest_text(s) + 1 < width / s->n_point;
}

static void draw_panel(const struct view *v, struct canvas *c) {
    const struct suite *s = v->s;
    const struct axis y = study_demand_axis(&v->demand, s, v->span);
    struct axis x = study_abscissa_axis(s);
    const bool texts = s->point_name, points = has_points(s);
    const double width = study_panel_width(c);
    double bottom = 3.2;
    if (texts) {
        x = (struct axis){.span = {0.5, s->n_point + 0.5}, .kind = AXIS_WITHOUT_NUMBERS};
        // The depth of the texts with their title; slanted texts are deeper.
        bottom = 3.6 + (texts_fit(s, width) ? 0 : 0.6 * fmin(name_width, widest_text(s)) - 0.4);
        study_foot(c, s->point_title);
    }
    study_panel(c, bottom, &x, &y);
    if (texts) {
        // Names below the axis replace the numbers. If there are too many, some are left out.
        const bool fit = texts_fit(s, width);
        const int every = 1 + (int)(1.4 * s->n_point / width);
        fprintf(c->to, "set xtics %s (", fit ? "norotate" : "rotate by 35 right");
        for (int i = 0; i < s->n_point; i += every) {
            panel_tic(c, i, s->point_name[s->order[i]], fit ? width : name_width, i + 1);
        }
        fprintf(c->to, ")\n");
    }
    if (v->band && points) {
        panel_series(c, (struct style){STYLE_BARS, .colour = script_colour[0], .width = 1},
                     "$group0 using 1:2:3:4");
    } else if (v->band) {
        panel_series(c, panel_area(band_colour), "$group0 using 1:3:4");
    }
    for (int g = 0; g < s->n_group; g++) {
        struct style median = panel_points(script_colour[g], script_point[g], 0);
        if (!points) {
            median.kind = STYLE_BOTH;
            median.width = 1.3;
        }
        panel_series(c, median, "$group%d using 1:2", g);
    }
    study_hit_series(s, c);
    panel_close(c);
}

static void draw(const struct subject *p, struct canvas *c) {
    const struct suite *s = p->suite;
    struct view v = {.s = s, .span = span_none, .band = s->n_group == 1 && s->n_sample > 1};
    study_demand_init(&v.demand, &s->edp);
    v.work = arena_alloc(s->arena, (size_t)s->n_sample, sizeof *v.work);
    if (!v.work) {
        c->status = error_no_memory(c->e);
        return;
    }
    write_data(&v, c->data);
    if (s->n_hit > 0) {
        write_hit(&v, c);
    }
    const bool named = strcmp(s->over, "sample") != 0;
    if (s->n_sample > 1) {
        study_head(c, s, "medians of %s over %d samples%s%s", v.demand.name, s->n_sample,
                   named ? " of " : "", named ? s->over : "");
    } else {
        study_head(c, s, "values of %s", v.demand.name);
    }
    write_legend(&v, c);
    draw_panel(&v, c);
}

const struct figure figure_response = {
    .name = "response",
    .doc = "a demand against a swept parameter: median and band, or a line for each group",
    .of = SUBJECT_STUDY,
    .guess = SUITE_ANY,
    .check = check,
    .draw = draw,
};
