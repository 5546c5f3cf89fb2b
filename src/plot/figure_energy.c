// SPDX-License-Identifier: GPL-3.0-or-later
// The components of the energy account (docs/theory.md, section 6), stacked, with dissipated ones
// at the bottom. The input is a line. The residual is below. Two runs stand side by side on the
// same scale.
#include <math.h>

#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { BINS = 200, PARTS = 5, TOTAL = PARTS + 1, RESIDUAL, N_COLUMN };

static const struct component {
    enum energy energy;
    const char *name, *colour;
} parts[PARTS] = {
    {ENERGY_DAMPING, "damping", "#0072b2"},  {ENERGY_HYSTERETIC, "yielding", "#009e73"},
    {ENERGY_CONTACT, "contacts", "#d55e00"}, {ENERGY_STRAIN, "strain", "#e69f00"},
    {ENERGY_KINETIC, "kinetic", "#56b4e9"},
};
static const struct style curve = {STYLE_LINE, .colour = "#404040", .width = 0.8};

// What all runs hold.
struct view {
    struct span energy, residual;
    bool part[PARTS];  // whether it is ever other than zero
};

// The parts summed up, from the first to this one; the total, initial + input; the residual.
static void write_data(const struct runs *s, int run, struct view *v, struct canvas *c) {
    struct history h[N_COLUMN] = {[TOTAL] = {HISTORY_ENERGY, ENERGY_INPUT, 0, 0},
                                  [RESIDUAL] = {HISTORY_ENERGY, ENERGY_RESIDUAL, 0, 0}};
    struct data d;
    for (int p = 0; p < PARTS; p++) {
        h[1 + p] = (struct history){HISTORY_ENERGY, (int)parts[p].energy, 0, 0};
    }
    if (runs_read(s, run, h, N_COLUMN, &d, c)) {
        for (size_t i = 0; i < d.n_row; i++) {
            for (int p = 0; p < PARTS; p++) {
                const double before = p > 0 ? d.column[p][i] : 0;
                d.column[1 + p][i] += before;
                v->part[p] |= d.column[1 + p][i] != before;
            }
            d.column[TOTAL][i] += s->r[run]->initial_energy;
        }
        data_span(&d, PARTS, &v->energy);
        data_span(&d, TOTAL, &v->energy);
        data_span(&d, RESIDUAL, &v->residual);
        data_write(&d, BINS, c, "time, parts summed up, total, residual", "energy%d", run);
    }
    data_free(&d);
}

// What the work on contacts and links was done on.
static const char *work_name(const struct runs *s) {
    bool contacts = false, links = false;
    for (int k = 0; k < s->n; k++) {
        contacts = contacts || s->r[k]->n_contact > 0;
        links = links || s->r[k]->n_link > 0;
    }
    return !links ? "contacts" : contacts ? "contacts and links" : "links";
}

static void write_head(const struct runs *s, struct canvas *c) {
    const struct report *r = s->r[0];
    char unit[64], in[32], contact[32];
    script_unit(&r->units, dimension_energy, unit, sizeof unit);
    script_number(r->initial_energy + r->energy[ENERGY_INPUT], in, sizeof in);
    script_number(r->energy[ENERGY_CONTACT], contact, sizeof contact);
    if (s->n > 1) {
        canvas_head(c, s->title, "energy components");
    } else if (r->n_contact + r->n_link > 0) {
        canvas_head(c, s->title, "energy: %s %s in, %s into %s", in, unit, contact, work_name(s));
    } else {
        canvas_head(c, s->title, "energy: %s %s in", in, unit);
    }
}

static struct axis energy_axis(const char *name, struct span span, int run) {
    return (struct axis){.name = run == 0 ? name : NULL,
                         .dimension = dimension_energy,
                         .span = span,
                         .kind = run == 0 ? AXIS_FULL : AXIS_WITHOUT_NUMBERS};
}

// The parts of a run on top of each other, and its residual below them.
static void draw_run(const struct runs *s, const struct view *v, int run, struct canvas *c) {
    const double x0 = (double)run / s->n, x1 = (run + 1.0) / s->n, top = s->n > 1 ? 1.6 : 0.7;
    panel_open(
        c, &(struct panel){.area = canvas_inset(canvas_part(c, x0, x1, 0.36, 1), 0, 0.8, 0.4, top),
                           .x = runs_time_axis(s, false),
                           .y = energy_axis("energy", v->energy, run),
                           .caption = s->n > 1 ? s->name[run] : NULL});
    for (int p = 0; p < PARTS; p++) {
        const struct style part = {STYLE_AREA, .colour = parts[p].colour};
        if (p == 0) {
            panel_series(c, part, "$energy%d using 1:(0):2", run);
        } else {
            panel_series(c, part, "$energy%d using 1:($%d):%d", run, p + 1, p + 2);
        }
    }
    panel_series(c, curve, "$energy%d using 1:%d", run, TOTAL + 1);
    panel_close(c);
    panel_open(
        c, &(struct panel){.area = canvas_inset(canvas_part(c, x0, x1, 0, 0.36), 0, 0.8, 3.2, 0.6),
                           .x = runs_time_axis(s, true),
                           .y = energy_axis("residual", v->residual, run)});
    panel_series(c, curve, "$energy%d using 1:%d", run, RESIDUAL + 1);
    panel_close(c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = {.energy = span_none, .residual = span_none};
    struct legend l = {0};
    for (int k = 0; k < s->n; k++) {
        write_data(s, k, &v, c);
    }
    v.energy = span_with_room(v.energy, 0);
    v.residual = span_with_room(v.residual, NAN);
    write_head(s, c);
    for (int p = 0; p < PARTS; p++) {
        if (v.part[p]) {
            legend_add(&l, panel_area(parts[p].colour),
                       parts[p].energy == ENERGY_CONTACT ? work_name(s) : parts[p].name, "");
        }
    }
    legend_add(&l, panel_line(curve.colour, 0),
               s->r[0]->initial_energy > 0 ? "initial + input" : "input", "");
    legend_write(&l, c);
    c->area.left += 5.8;
    for (int k = 0; k < s->n; k++) {
        draw_run(s, &v, k, c);
    }
}

const struct figure figure_energy = {
    .name = "energy",
    .doc = "energy components, stacked, and the residual",
    .draw = draw,
};
