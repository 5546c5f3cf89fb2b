// SPDX-License-Identifier: GPL-3.0-or-later
// Peak displacement, drift, acceleration and storey shear over the height. Floors are points,
// storeys are steps. Free bodies have no storeys; where there is nothing else, only the panels of
// floors are drawn. Of many buildings, those with the largest drift are shown. A second run is
// dashed.
#include <math.h>

#include "plot/figure.h"
#include "plot/script.h"

enum { BUILDINGS_MAX = SCRIPT_COLOURS, PANELS = 4 };

struct panel {
    enum peak peak;
    const char *name, *brief;
    const struct dimension *dimension;
    const char *data;  // name of its data blocks: floors or storeys
    int column;
};
static const struct panel panels[PANELS] = {
    {PEAK_DISPLACEMENT, "displacement", "displ.", &dimension_length, "floors", 2},
    {PEAK_DRIFT, "storey drift", "drift", &dimension_length, "storeys", 2},
    {PEAK_ACCELERATION, "acceleration", "accel.", &dimension_acceleration, "floors", 3},
    {PEAK_SHEAR, "shear", NULL, &dimension_force, "storeys", 3},
};

struct selection {
    const struct runs *s;
    int building[BUILDINGS_MAX];
    int n;
    bool heights;  // all shown buildings have them
    bool storeys;  // one of them at least is no free body
};

static bool is_of_storeys(const struct panel *p) {
    return p->data[0] == 's';
}

// Of floor i or the storey below it; NAN where a free body has none.
static double value_of(const struct report_building *b, const struct panel *p, int i) {
    return is_of_storeys(p) && b->stiffness[i] == 0 ? (double)NAN : b->peak[p->peak][i];
}

static double largest_drift(const struct report_building *b) {
    double value = 0;
    for (int i = 0; i < b->n_floor; i++) {
        value = fmax(value, value_of(b, &panels[1], i));
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
        for (int i = 0; i < b->n_floor; i++) {
            s.heights = s.heights && b->height[i] > 0;
            s.storeys = s.storeys || b->stiffness[i] > 0;
        }
    }
    return s;
}

static const struct report_building *shown(const struct selection *s, int run, int k) {
    return &s->s->r[run]->building[s->building[k]];
}

static void write_building(const struct selection *s, int run, int k, FILE *to) {
    const struct report_building *b = shown(s, run, k);
    double level = 0;
    fprintf(to, "$floors%d%d << EOD\n# level displacement acceleration\n0 %s NaN\n", run, k,
            b->stiffness[0] > 0 ? "0" : "NaN");
    for (int i = 0; i < b->n_floor; i++) {
        level += s->heights ? b->height[i] : 1;
        fprintf(to, "%.9g %.9g %.9g\n", level, b->peak[PEAK_DISPLACEMENT][i],
                b->peak[PEAK_ACCELERATION][i]);
    }
    fprintf(to, "EOD\n$storeys%d%d << EOD\n# level drift shear, both ends of each storey\n", run,
            k);
    level = 0;
    for (int i = 0; i < b->n_floor; i++) {
        const double height = s->heights ? b->height[i] : 1;
        const double drift = value_of(b, &panels[1], i) / (s->heights ? height / 100 : 1);
        const double shear = value_of(b, &panels[3], i);
        fprintf(to, "%.9g %.9g %.9g\n%.9g %.9g %.9g\n", level, drift, shear, level + height, drift,
                shear);
        level += height;
    }
    fprintf(to, "EOD\n");
}

static struct span panel_span(const struct selection *s, const struct panel *p) {
    struct span span = span_none;
    for (int k = 0; k < s->n * s->s->n; k++) {
        const struct report_building *b = shown(s, k / s->n, k % s->n);
        for (int i = 0; i < b->n_floor; i++) {
            const bool ratio = p->peak == PEAK_DRIFT && s->heights;
            span_add(&span, value_of(b, p, i) / (ratio ? b->height[i] / 100 : 1));
        }
    }
    return span_with_room(span, 0);
}

static double top_level(const struct selection *s) {
    double top = 0;
    for (int k = 0; k < s->n * s->s->n; k++) {
        const struct report_building *b = shown(s, k / s->n, k % s->n);
        double level = 0;
        for (int i = 0; i < b->n_floor; i++) {
            level += s->heights ? b->height[i] : 1;
        }
        top = fmax(top, level);
    }
    return top;
}

// The panel `at` of `n` beside each other.
static void write_panel(const struct selection *s, const struct panel *p, int at, int n,
                        struct canvas *c) {
    const bool ratio = p->peak == PEAK_DRIFT && s->heights;
    const struct axis x = {.name = ratio ? "drift / height" : p->name,
                           .brief = p->brief,
                           .unit = ratio ? "%" : NULL,
                           .dimension = *p->dimension,
                           .span = panel_span(s, p)};
    const struct axis y = {.name = at > 0       ? NULL
                                   : s->heights ? "height"
                                                : "floor",
                           .unit = s->heights ? NULL : "",
                           .dimension = dimension_length,
                           .span = {0, 1.02 * top_level(s)},
                           .kind = at > 0 ? AXIS_WITHOUT_NUMBERS : AXIS_FULL,
                           .step = s->heights ? 0 : 1};
    struct canvas within = *c;
    within.area.left += 4.2;
    const struct area part = canvas_part(&within, (double)at / n, (at + 1.0) / n, 0, 1);
    canvas_panel(c, canvas_inset(part, 1.1, 1.1, 3.2, 0.5), &s->s->r[0]->units, &x, &y);
    fprintf(c->to, "plot");
    for (int k = 0; k < s->n * s->s->n; k++) {
        const int run = k / s->n, building = k % s->n;
        fprintf(c->to, "%s \\\n  $%s%d%d using %d:1 with %s lc rgb '%s' dt %s", k > 0 ? "," : "",
                p->data, run, building, p->column, is_of_storeys(p) ? "lines" : "linespoints",
                script_colour[building], run > 0 ? "(10,6)" : "solid");
        if (!is_of_storeys(p)) {
            fprintf(c->to, " pt %d ps 1*point", run > 0 ? POINT_RING : POINT_DISC);
        }
    }
    fprintf(c->to, "\n");
    canvas_panel_end(c);
}

static void write_head(const struct selection *s, struct canvas *c) {
    const struct report *r = s->s->r[0];
    char text[160] = "largest absolute values over all computed steps; total accelerations";
    if (s->n < r->n_building) {
        snprintf(text, sizeof text,
                 "largest absolute values of the %d of %d buildings that drift most", s->n,
                 r->n_building);
    }
    canvas_head(c, runs_title(s->s), text);
    struct legend l = {0};
    for (int k = 0; k < s->n; k++) {
        legend_add(&l, (struct mark){.kind = MARK_LINE, .colour = script_colour[k]},
                   shown(s, 0, k)->name, "");
    }
    runs_legend(s->s, "#808080", &l);
    legend_write(&l, c);
}

static int draw(const struct runs *runs, struct canvas *c, struct error *e) {
    (void)e;
    const struct selection s = choose(runs);
    for (int k = 0; k < s.n * runs->n; k++) {
        write_building(&s, k / s.n, k % s.n, c->data);
    }
    write_head(&s, c);
    const int n = s.storeys ? PANELS : PANELS - 2;
    for (int i = 0, at = 0; i < PANELS; i++) {
        if (s.storeys || !is_of_storeys(&panels[i])) {
            write_panel(&s, &panels[i], at++, n, c);
        }
    }
    return STATUS_OK;
}

const struct figure figure_profiles = {
    .name = "profiles",
    .doc = "peak displacement, drift, acceleration and shear over the height",
    .draw = draw,
};
