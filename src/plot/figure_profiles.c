// SPDX-License-Identifier: GPL-3.0-or-later
// Peak displacement, drift, acceleration and storey shear over the height. Floors are points,
// storeys are steps. Free bodies have no storeys; where there is nothing else, only the panels of
// floors are drawn. Of many buildings, those with the largest drift are shown. A second run is
// dashed. Buildings of one floor have no profile: each has a row instead. Floors that were hit have
// a large ring around their acceleration.
#include <math.h>

#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

enum { BUILDINGS_MAX = SCRIPT_COLOURS, PANELS = 4 };

struct profile {
    enum peak peak;
    const char *name, *brief;
    const struct dimension *dimension;
    bool storeys;  // of storeys, not of floors
    int column;    // of the data blocks
};
static const struct profile profiles[PANELS] = {
    {PEAK_DISPLACEMENT, "displacement", "displ.", &dimension_length, false, 2},
    {PEAK_DRIFT, "storey drift", "drift", &dimension_length, true, 2},
    {PEAK_ACCELERATION, "acceleration", "accel.", &dimension_acceleration, false, 3},
    {PEAK_SHEAR, "storey shear", "shear", &dimension_force, true, 3},
};

struct selection {
    const struct runs *s;
    int building[BUILDINGS_MAX];
    int n;
    bool heights;  // all shown buildings have them
    bool storeys;  // one of them at least is no free body
    bool rows;     // none has more than one floor
    int floors;    // of the highest
    bool points;   // there is room for those of all floors
    bool hit;      // a contact force has acted on one of the shown floors
};

static const double NAME_WIDTH = 9, ROW_HEIGHT = 1.4;  // [em]

// Of floor i or the storey below it; NAN where a free body has none.
static double value_of(const struct report_building *b, const struct profile *p, int i) {
    return p->storeys && b->stiffness[i] == 0 ? (double)NAN : b->peak[p->peak][i];
}

static double largest_drift(const struct report_building *b) {
    double value = 0;
    for (int i = 0; i < b->n_floor; i++) {
        value = fmax(value, value_of(b, &profiles[1], i));
    }
    return value;
}

// Place of the chosen building with the smallest drift.
static int least_drift(const struct selection *s) {
    const struct report_building *b = s->s->r[0]->building;
    int least = 0;
    for (int k = 1; k < s->n; k++) {
        const double drift = largest_drift(&b[s->building[k]]);
        least = drift < largest_drift(&b[s->building[least]]) ? k : least;
    }
    return least;
}

// Keeps the buildings with the largest drift, in their order of position.
static struct selection choose(const struct runs *runs) {
    struct selection s = {.s = runs, .heights = true};
    const struct report *r = runs->r[0];
    for (int i = 0; i < r->n_building; i++) {
        if (s.n == BUILDINGS_MAX) {
            const int least = least_drift(&s);
            if (largest_drift(&r->building[i]) <= largest_drift(&r->building[s.building[least]])) {
                continue;
            }
            for (int k = least; k + 1 < s.n; k++) {
                s.building[k] = s.building[k + 1];
            }
            s.n--;
        }
        s.building[s.n++] = i;
    }
    for (int k = 0; k < s.n * runs->n; k++) {
        const struct report_building *b = &runs->r[k / s.n]->building[s.building[k % s.n]];
        s.floors = b->n_floor > s.floors ? b->n_floor : s.floors;
        s.heights = s.heights && runs_has_heights(b);
        for (int i = 0; i < b->n_floor; i++) {
            s.storeys = s.storeys || b->stiffness[i] > 0;
            s.hit = s.hit || report_floor_was_hit(runs->r[k / s.n], b->name, i + 1);
        }
    }
    s.rows = s.floors == 1;
    return s;
}

static const struct report_building *shown(const struct selection *s, int run, int k) {
    return &s->s->r[run]->building[s->building[k]];
}

// Drifts are in percent where there are heights.
static double drawn_value(const struct selection *s, const struct report_building *b,
                          const struct profile *p, int i) {
    const bool ratio = p->peak == PEAK_DRIFT && s->heights;
    return value_of(b, p, i) / (ratio ? b->height[i] / 100 : 1);
}

// The place of a level of a building. Where buildings have rows, these count upwards, and a second
// run stands below the first.
static double place_of(const struct selection *s, int run, int k, int floors) {
    const double row = s->n - k + (s->s->n > 1 ? 0.15 - 0.3 * run : 0);
    return s->rows ? row : runs_level(shown(s, run, k), floors, s->heights);
}

// Floors, storeys (both ends of each; a row is one point), and the accelerations of the floors that
// were hit.
static void write_building(const struct selection *s, int run, int k, struct canvas *c) {
    const struct report_building *b = shown(s, run, k);
    canvas_block(c, "level or row, displacement, acceleration", "floors%d%d", run, k);
    if (!s->rows) {
        fprintf(c->data, "0 %s NaN\n", b->stiffness[0] > 0 ? "0" : "NaN");
    }
    for (int i = 0; i < b->n_floor; i++) {
        fprintf(c->data, "%.9g %.9g %.9g\n", place_of(s, run, k, i + 1),
                b->peak[PEAK_DISPLACEMENT][i], b->peak[PEAK_ACCELERATION][i]);
    }
    canvas_end(c);
    canvas_block(c, "level or row, drift, shear", "storeys%d%d", run, k);
    for (int i = 0; i < (s->rows ? 1 : 2 * b->n_floor); i++) {
        fprintf(c->data, "%.9g %.9g %.9g\n", place_of(s, run, k, (i + 1) / 2),
                drawn_value(s, b, &profiles[1], i / 2), drawn_value(s, b, &profiles[3], i / 2));
    }
    canvas_end(c);
    canvas_block(c, "level or row, acceleration of floors that were hit", "hit%d%d", run, k);
    fputs("NaN NaN\n", c->data);
    for (int i = 0; i < b->n_floor; i++) {
        if (report_floor_was_hit(s->s->r[run], b->name, i + 1)) {
            fprintf(c->data, "%.9g %.9g\n", place_of(s, run, k, i + 1),
                    b->peak[PEAK_ACCELERATION][i]);
        }
    }
    canvas_end(c);
}

static struct span panel_span(const struct selection *s, const struct profile *p) {
    struct span span = span_none;
    for (int k = 0; k < s->n * s->s->n; k++) {
        const struct report_building *b = shown(s, k / s->n, k % s->n);
        for (int i = 0; i < b->n_floor; i++) {
            span_add(&span, drawn_value(s, b, p, i));
        }
    }
    return span_with_room(span, 0);
}

static double top_level(const struct selection *s) {
    double top = 0;
    for (int k = 0; k < s->n * s->s->n; k++) {
        const struct report_building *b = shown(s, k / s->n, k % s->n);
        top = fmax(top, runs_level(b, b->n_floor, s->heights));
    }
    return top;
}

static struct axis value_axis(const struct selection *s, const struct profile *p) {
    const bool ratio = p->peak == PEAK_DRIFT && s->heights;
    return (struct axis){.name = ratio ? "drift / height" : p->name,
                         .brief = ratio ? NULL : p->brief,
                         .unit = ratio ? "%" : NULL,
                         .dimension = *p->dimension,
                         .span = panel_span(s, p)};
}

// A curve for each building; those of one floor have a row instead, a line from 0 with a point.
static void draw_series(const struct selection *s, const struct profile *p, struct canvas *c) {
    const char *data = p->storeys ? "storeys" : "floors";
    for (int k = 0; k < s->n * s->s->n; k++) {
        const int run = k / s->n, building = k % s->n;
        const bool points = s->rows || (s->points && !p->storeys);
        struct style line = panel_line(script_colour[building], s->rows ? 1.5 : 0);
        struct style point = panel_points(
            line.colour, run > 0 ? POINT_RING : script_point[building], s->rows ? 1.8 : 1.2);
        line.dash = run > 0 ? "(10,6)" : "solid";
        if (s->rows) {
            line.kind = STYLE_VECTOR;
            panel_series(c, line, "$%s%d%d using (0):1:%d:(0)", data, run, building, p->column);
        } else if (points) {
            point.kind = STYLE_BOTH;
            point.dash = line.dash;
        }
        panel_series(c, points ? point : line, "$%s%d%d using %d:1", data, run, building,
                     p->column);
    }
    // Large rings around the accelerations of floors that were hit.
    for (int k = 0; p->peak == PEAK_ACCELERATION && s->hit && k < s->n * s->s->n; k++) {
        panel_series(c, panel_points(script_colour[k % s->n], POINT_RING, 2.8),
                     "$hit%d%d using 2:1", k / s->n, k % s->n);
    }
    panel_close(c);
}

// Names of buildings beside their rows.
static void write_names(const struct selection *s, const struct canvas *c) {
    fprintf(c->to, "set ytics (");
    for (int k = 0; k < s->n; k++) {
        panel_tic(c, k, shown(s, 0, k)->name, NAME_WIDTH, s->n - k);
    }
    fprintf(c->to, ")\n");
}

// Panel `at` of `n` beside each other; of rows, two above each other where there is room.
static void draw_panel(const struct selection *s, const struct profile *p, int at, int n,
                       struct canvas *c) {
    struct canvas within = *c;
    double names = 0;
    for (int k = 0; k < s->n; k++) {
        names = fmax(names, fmin(NAME_WIDTH, script_width(shown(s, 0, k)->name)));
    }
    within.area.left += s->rows ? names : 4.2;
    const double height = c->area.top - c->area.bottom;
    const bool two = s->rows && height > 2 * (ROW_HEIGHT * (s->n + 0.2) + 3.7);
    const int across = two ? 2 : n, column = at % across, line = at / across, lines = n / across;
    const struct area a = canvas_part(&within, (double)column / across, (column + 1.0) / across,
                                      1 - (line + 1.0) / lines, 1 - (double)line / lines);
    const struct axis rows = {.span = {0.4, s->n + 0.6}, .kind = AXIS_WITHOUT_NUMBERS, .step = 1};
    panel_open(c, &(struct panel){
                      .area = canvas_inset(a, 1.1, 1.1, 3.2, 0.5),
                      .x = value_axis(s, p),
                      .y = s->rows ? rows : runs_height_axis(at == 0, s->heights, top_level(s))});
    if (s->rows && column == 0) {
        write_names(s, c);
    }
    draw_series(s, p, c);
}

// Rows have their names beside them; a free body has a point on each panel, but no line.
static void write_legend(const struct selection *s, struct canvas *c) {
    struct legend l = {0};
    for (int k = 0; k < s->n && !s->rows; k++) {
        const struct report_building *b = shown(s, 0, k);
        const bool line = b->n_floor > 1 || b->stiffness[0] > 0;
        legend_add(&l,
                   (struct style){.kind = line ? STYLE_LINE : STYLE_POINTS,
                                  .colour = script_colour[k],
                                  .size = 1.2,
                                  .point = s->points ? script_point[k] : 0},
                   b->name, "");
    }
    if (s->hit) {
        legend_add(&l, panel_points("#808080", POINT_RING, 2.8), report_hit_name, "");
    }
    runs_legend(s->s, "#808080", &l);
    legend_write(&l, c);
}

static void write_head(const struct selection *s, struct canvas *c) {
    const int n = s->s->r[0]->n_building;
    char of[80] = "over all steps";
    if (s->n < n) {
        snprintf(of, sizeof of, "of the %d of %d buildings that drift most", s->n, n);
    }
    canvas_head(c, s->s->title, "peaks %s; relative displacements, total accelerations", of);
    write_legend(s, c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *runs = subject->runs;
    struct selection s = choose(runs);
    s.points = canvas_has_room(c, s.floors);
    for (int k = 0; k < s.n * runs->n; k++) {
        write_building(&s, k / s.n, k % s.n, c);
    }
    write_head(&s, c);
    const int n = s.storeys ? PANELS : PANELS - 2;
    for (int i = 0, at = 0; i < PANELS; i++) {
        if (s.storeys || !profiles[i].storeys) {
            draw_panel(&s, &profiles[i], at++, n, c);
        }
    }
}

const struct figure figure_profiles = {
    .name = "profiles",
    .doc = "peak displacement, drift, acceleration and shear over the height",
    .draw = draw,
};
