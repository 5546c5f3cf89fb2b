// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/pictures.h"

#include <assert.h>
#include <math.h>

#include "plot/script.h"

enum { SAMPLES_SHOWN = 1500 };  // pairs of a smallest and a largest one

// Of the contact, how much of a record is shown before and after.
static const double AROUND = 0.15;

static const struct scale times[] = {{1.0, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {0.0, NULL}};

// What is shown, in SI.
struct extent {
    struct span force, time, depth;
};

struct scales {
    struct scale force, time, length;
};

// The curve from a force of 0 at closure to one of 0 at opening.
static void write_curve(const struct impact_curve *curve, int number, const struct scales *s,
                        struct canvas *c) {
    canvas_block(c, "time force penetration", "curve%d", number);
    for (size_t i = 0; i < curve->n; i++) {
        const struct isolated_point *p = &curve->point[i];
        const double time = (curve->start + p->time) / s->time.size;
        const double depth = p->penetration / s->length.size;
        const bool edge = i == 0 || i + 1 == curve->n;
        if (i == 0) {
            fprintf(c->data, "%.9g 0 %.9g\n", time, depth);
        }
        fprintf(c->data, "%.9g %.9g %.9g\n", time, p->force / s->force.size, depth);
        if (edge && i > 0) {
            fprintf(c->data, "%.9g 0 %.9g\n", time, depth);
        }
    }
    canvas_end(c);
}

static void write_samples(const struct impact_figure *f, const struct scales *s, struct canvas *c) {
    struct data d = {.n_row = 0};
    if (c->status == STATUS_OK) {
        c->status = data_create(&d, (long)f->n_sample, 2, c->e);
    }
    for (size_t i = 0; i < d.n_row; i++) {
        d.column[0][i] = f->time[i] / s->time.size;
        d.column[1][i] = f->force[i] / s->force.size;
    }
    if (c->status == STATUS_OK) {
        data_write(&d, SAMPLES_SHOWN, c, "time force", "measured");
    }
    data_free(&d);
}

static void draw_panels(const struct impact_figure *f, const struct extent *x,
                        const struct scales *s, struct canvas *c) {
    const double top = f->impact ? 1.6 : 0.7;
    char over_time[128] = "", over_depth[128] = "";
    if (f->impact) {
        // The numbers of the impact in the units of the axes below.
        size_t size = sizeof over_time;
        const struct isolated_impact *i = f->impact;
        char asked[48] = "";
        if (!isnan(f->nominal)) {
            snprintf(asked, sizeof asked, " (asked %.4g)", f->nominal);
        }
        snprintf(over_time, size, "largest %.4g %s, over %.4g %s", i->peak_force / s->force.size,
                 s->force.unit, i->duration / s->time.size, s->time.unit);
        snprintf(over_depth, size, "e %.4g%s, %.4g %s", i->restitution, asked,
                 i->max_penetration / s->length.size, s->length.unit);
    }
    c->area.left += 5.8;
    struct panel p = {
        .area = canvas_inset(canvas_part(c, 0, 0.5, 0, 1), 0, 0.8, 3.2, top),
        .x = pictures_scaled_axis("time", &s->time, span_with_room(x->time, x->time.low)),
        .y = pictures_scaled_axis("contact force", &s->force,
                                  span_with_room(x->force, x->force.low < 0 ? NAN : 0)),
        .caption = over_time};
    pictures_law_panel(c, &p, f->n_curve, 1, 2, f->n_sample > 0 ? 0.8 : 0);
    p.area = canvas_inset(canvas_part(c, 0.5, 1, 0, 1), 0.8, 0.5, 3.2, top);
    p.x = pictures_scaled_axis("penetration", &s->length, span_with_room(x->depth, 0));
    p.y.name = NULL;
    p.y.kind = AXIS_WITHOUT_NUMBERS;
    p.caption = over_depth;
    pictures_law_panel(c, &p, f->n_curve, 3, 2, 0);
}

int impact_figure_write(const struct impact_figure *f, const struct figure_files *to,
                        struct error *e) {
    assert(f->n_curve <= IMPACT_FIGURE_CURVES);
    struct unit_system si;
    unit_system_init(&si);
    const struct figure_head head = {
        .name = "impact", .doc = "force of isolated impacts", .version = f->version, .units = &si};
    struct extent x = {span_none, span_none, span_none};
    for (int c = 0; c < f->n_curve; c++) {
        const struct impact_curve *curve = &f->curve[c];
        for (size_t i = 0; i < curve->n; i++) {
            const struct isolated_point *p = &curve->point[i];
            span_add(&x.time, curve->start + p->time);
            span_add(&x.force, p->force);
            span_add(&x.depth, p->penetration);
        }
    }
    if (f->n_sample > 0) {
        const double margin = AROUND * (x.time.high - x.time.low);
        x.time = (struct span){x.time.low - margin, x.time.high + margin};
    }
    for (size_t i = 0; i < f->n_sample; i++) {
        if (f->time[i] >= x.time.low && f->time[i] <= x.time.high) {
            span_add(&x.force, f->force[i]);
        }
    }
    span_add(&x.force, 0);
    const struct scales s = {.force =
                                 pictures_scale(pictures_forces, fmax(x.force.high, -x.force.low)),
                             .time = pictures_scale(times, x.time.high - x.time.low),
                             .length = pictures_scale(pictures_lengths, x.depth.high)};
    struct canvas canvas;
    figure_open(&head, to, &canvas, e);
    const char *name[IMPACT_FIGURE_CURVES];
    for (int c = 0; c < f->n_curve; c++) {
        name[c] = f->curve[c].name;
        write_curve(&f->curve[c], c, &s, &canvas);
    }
    if (f->n_sample > 0) {
        write_samples(f, &s, &canvas);
    }
    canvas_head(&canvas, f->title, "%s", f->subtitle);
    pictures_law_legend(&canvas, name, f->n_curve, f->n_sample);
    draw_panels(f, &x, &s, &canvas);
    return figure_close(&canvas);
}

int impact_figure_write_forces(const struct force_figure *f, const struct figure_files *to,
                               struct error *e) {
    assert(f->n_curve <= IMPACT_FIGURE_CURVES);
    struct unit_system si;
    unit_system_init(&si);
    const struct figure_head head = {.name = "over",
                                     .doc = "peak force of isolated impacts",
                                     .version = f->version,
                                     .units = &si};
    struct span x = span_none, y = span_none;
    for (int c = 0; c < f->n_curve; c++) {
        for (size_t i = 0; i < f->curve[c].n; i++) {
            span_add(&x, f->curve[c].x[i]);
            span_add(&y, f->curve[c].force[i]);
        }
    }
    struct canvas canvas;
    figure_open(&head, to, &canvas, e);
    const struct scale force = pictures_scale(pictures_forces, y.high);
    struct legend l = {0};
    for (int c = 0; c < f->n_curve; c++) {
        canvas_block(&canvas, "value force", "force%d", c);
        for (size_t i = 0; i < f->curve[c].n; i++) {
            fprintf(to->data, "%.9g %.9g\n", f->curve[c].x[i], f->curve[c].force[i] / force.size);
        }
        canvas_end(&canvas);
        legend_add(&l, panel_line(script_colour[c], 0), f->curve[c].name, "");
    }
    canvas_head(&canvas, "Peak force of an isolated impact", "%s", f->subtitle);
    legend_write(&l, &canvas);
    panel_open(&canvas, &(struct panel){
                            .area = canvas_inset(canvas.area, 5.8, 0.8, 3.2, 0.7),
                            .x = {.name = f->name,
                                  .unit = f->unit,
                                  .span = x,
                                  .kind = f->logarithmic ? AXIS_LOGARITHMIC : AXIS_FULL},
                            .y = pictures_scaled_axis("peak force", &force, span_with_room(y, 0))});
    for (int c = 0; c < f->n_curve; c++) {
        panel_series(&canvas, panel_line(script_colour[c], 0), "$force%d using 1:2", c);
    }
    panel_close(&canvas);
    return figure_close(&canvas);
}
