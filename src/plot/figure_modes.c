// SPDX-License-Identifier: GPL-3.0-or-later
// The first mode shapes of each building alone, on its initial stiffness, each scaled to a largest
// value of 1. Of many buildings the first are shown. A second run is dashed.
#include <math.h>
#include <stdlib.h>

#include "model/modes.h"
#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { BUILDINGS_MAX = SCRIPT_COLOURS, MODES_MAX = 4 };

struct view {
    const struct runs *s;
    int n_building, n_mode;
    bool heights;                 // all shown buildings have them
    double top;                   // [L], or floors
    bool points;                  // there is room for those of all floors
    bool unknown[BUILDINGS_MAX];  // its shapes, for want of its stiffness
};

static const struct report_building *shown(const struct view *v, int run, int k) {
    return &v->s->r[run]->building[k];
}

static struct view choose(const struct runs *s, const struct canvas *c) {
    const struct report *r = s->r[0];
    struct view v = {.s = s,
                     .n_building = r->n_building < BUILDINGS_MAX ? r->n_building : BUILDINGS_MAX,
                     .heights = true};
    for (int k = 0; k < s->n * v.n_building; k++) {
        const struct report_building *b = shown(&v, k / v.n_building, k % v.n_building);
        v.n_mode = b->n_floor > v.n_mode ? b->n_floor : v.n_mode;
        v.heights = v.heights && runs_has_heights(b);
    }
    v.points = canvas_has_room(c, v.n_mode);
    v.n_mode = v.n_mode < MODES_MAX ? v.n_mode : MODES_MAX;
    for (int k = 0; k < s->n * v.n_building; k++) {
        const struct report_building *b = shown(&v, k / v.n_building, k % v.n_building);
        v.top = fmax(v.top, runs_level(b, b->n_floor, v.heights));
    }
    return v;
}

// A row for each floor: its level and the modes; those that a low building does not have, and those
// that are not known, are NaN.
static void write_shape(struct view *v, int run, int k, const double *omega, const double *shape,
                        struct canvas *c) {
    const struct report_building *b = shown(v, run, k);
    const int n = b->n_floor;
    // known: these are the periods of the building. They are not if the building has parts, whose
    // stiffness is not in the file.
    bool known = true;
    for (int m = 0; m < n; m++) {
        const double cycles = omega[m] * b->period[m] / (2 * acos(-1.0));
        known = known && (omega[m] > 0 ? fabs(cycles - 1) < 1e-6 : !isfinite(b->period[m]));
    }
    v->unknown[k] = v->unknown[k] || !known;
    canvas_block(c, "level, modes", "shapes%d%d", run, k);
    for (int i = -1; i < n; i++) {
        fprintf(c->data, "%.7g", runs_level(b, i + 1, v->heights));
        for (int m = 0; m < v->n_mode; m++) {
            const double at_base = omega[m < n ? m : 0] > 0 ? 0 : (double)NAN;
            const double value =
                i < 0 ? at_base : shape[(size_t)(m < n ? m : 0) * (size_t)n + (size_t)i];
            fprintf(c->data, " %.7g", m < n && known ? value : (double)NAN);
        }
        fputc('\n', c->data);
    }
    canvas_end(c);
}

static void write_shapes(struct view *v, int run, int k, struct canvas *c) {
    const struct report_building *b = shown(v, run, k);
    const int n = b->n_floor;
    double *shape = malloc(((size_t)n + 2) * (size_t)n * sizeof *shape);
    if (!shape) {
        c->status = error_no_memory(c->e);
        return;
    }
    double *omega = shape + (size_t)n * (size_t)n, *stiffness = omega + n;
    for (int i = 0; i < n; i++) {
        stiffness[i] = b->stiffness[i] - (b->axial ? b->axial[i] / b->height[i] : 0);
    }
    if (c->status == STATUS_OK) {
        c->status = modes_solve(n, b->mass, stiffness, NULL, omega, shape, c->e);
    }
    if (c->status == STATUS_OK) {
        modes_scale_to_largest(n, shape);
        write_shape(v, run, k, omega, shape, c);
    }
    free(shape);
}

// Where shapes coincide the later points lie on the earlier ones, which are larger.
static double point_size(const struct view *v, int building) {
    return 1 + 2.5 * (v->n_building - 1 - building) / v->n_building;
}

static void draw_panel(const struct view *v, struct canvas *c, struct area a, int mode) {
    char text[32];
    snprintf(text, sizeof text, "mode %d", mode + 1);
    panel_open(c,
               &(struct panel){.area = a,
                               .x = {.name = "shape", .unit = "", .span = {-1.1, 1.1}, .step = 1},
                               .y = runs_height_axis(mode == 0, v->heights, v->top),
                               .caption = text});
    for (int k = 0; k < v->n_building * v->s->n; k++) {
        const int run = k / v->n_building, building = k % v->n_building;
        panel_series(c,
                     (struct style){v->points ? STYLE_BOTH : STYLE_LINE,
                                    .colour = script_colour[building],
                                    .dash = run > 0 ? "(10,6)" : "solid",
                                    .point = run > 0 ? POINT_RING : script_point[building],
                                    .size = point_size(v, building)},
                     "$shapes%d%d using %d:1", run, building, mode + 2);
    }
    panel_close(c);
}

// Three digits, but no point behind the last one.
static void write_period(double period, char *text, size_t size) {
    if (period >= 1e-3 && period < 99.5) {
        snprintf(text, size, "%#.3g", period);
    } else {
        script_number(period, text, size);
    }
}

// The name of a building with its first periods.
static void add_entry(const struct view *v, struct legend *l, int k) {
    const struct report_building *b = shown(v, 0, k);
    char text[128] = ":";
    size_t n = 1;
    for (int m = 0; m < v->n_mode && m < b->n_floor && m < 3; m++) {
        char period[32] = "rigid body";
        if (isfinite(b->period[m])) {
            write_period(b->period[m], period, sizeof period);
        }
        n += (size_t)snprintf(text + n, sizeof text - n, "%s %s", m > 0 ? "," : "", period);
    }
    if (isfinite(b->period[0])) {
        snprintf(text + n, sizeof text - n, " %s%s", v->s->r[0]->units.time_name,
                 v->unknown[k] ? ", shapes not in the file" : "");
    }
    const bool line = b->n_floor > 1 || b->stiffness[0] > 0;
    legend_add(l,
               (struct style){.kind = line ? STYLE_LINE : STYLE_POINTS,
                              .colour = script_colour[k],
                              .size = point_size(v, k),
                              .point = v->points ? script_point[k] : 0},
               b->name, text);
}

static void write_head(const struct view *v, struct canvas *c) {
    const int n = v->s->r[0]->n_building;
    struct legend l = {0};
    if (n > v->n_building) {
        canvas_head(c, v->s->title,
                    "mode shapes of the first %d of %d buildings, and their first periods",
                    v->n_building, n);
    } else {
        canvas_head(c, v->s->title, "mode shapes of each building alone, and its first periods");
    }
    for (int k = 0; k < v->n_building; k++) {
        add_entry(v, &l, k);
    }
    runs_legend(v->s, "#808080", &l);
    legend_write(&l, c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = choose(s, c);
    for (int k = 0; k < s->n * v.n_building; k++) {
        write_shapes(&v, k / v.n_building, k % v.n_building, c);
    }
    write_head(&v, c);
    c->area.left += 4.2;
    const double width = 1.0 / (v.n_mode > 2 ? v.n_mode : 3), first = (1 - v.n_mode * width) / 2;
    for (int m = 0; m < v.n_mode; m++) {
        const struct area part = canvas_part(c, first + m * width, first + (m + 1) * width, 0, 1);
        draw_panel(&v, c, canvas_inset(part, 1.1, 1.1, 3.2, 1.8), m);
    }
}

const struct figure figure_modes = {
    .name = "modes",
    .doc = "mode shapes and periods of each building",
    .draw = draw,
};
