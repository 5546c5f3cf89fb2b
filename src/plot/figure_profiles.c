// SPDX-License-Identifier: GPL-3.0-or-later
// Peak displacement, drift, acceleration and storey shear over the height. Floors are points,
// storeys are steps. Of many buildings, those with the largest drift are shown.
#include <math.h>
#include <stdlib.h>

#include "plot/figure.h"
#include "plot/script.h"

enum { BUILDINGS_MAX = SCRIPT_LEGEND_MAX, PANELS = 4 };

struct panel {
    enum peak peak;
    const char *name;
    const struct dimension *dimension;
    const char *data;  // name of its data blocks: floors or storeys
    int column;
};
static const struct panel panels[PANELS] = {
    {PEAK_DISPLACEMENT, "displacement", &dimension_length, "floors", 2},
    {PEAK_DRIFT, "storey drift", &dimension_length, "storeys", 2},
    {PEAK_ACCELERATION, "total acceleration", &dimension_acceleration, "floors", 3},
    {PEAK_SHEAR, "storey shear", &dimension_force, "storeys", 3},
};

struct selection {
    const struct report *r;
    int building[BUILDINGS_MAX];
    int n;
    bool heights;  // all shown buildings have them
};

static double largest(const struct report_building *b, enum peak peak) {
    double value = 0;
    for (int i = 0; i < b->n_floor; i++) {
        value = fmax(value, b->peak[peak][i]);
    }
    return value;
}

// Place of the chosen building with the smallest drift.
static int least_drift(const struct selection *s) {
    int least = 0;
    for (int k = 1; k < s->n; k++) {
        const double drift = largest(&s->r->building[s->building[k]], PEAK_DRIFT);
        least = drift < largest(&s->r->building[s->building[least]], PEAK_DRIFT) ? k : least;
    }
    return least;
}

// Keeps the buildings with the largest drift, in their order of position.
static struct selection choose(const struct report *r) {
    struct selection s = {.r = r, .heights = true};
    for (int i = 0; i < r->n_building; i++) {
        if (s.n == BUILDINGS_MAX) {
            const int least = least_drift(&s);
            if (largest(&r->building[i], PEAK_DRIFT) <=
                largest(&r->building[s.building[least]], PEAK_DRIFT)) {
                continue;
            }
            for (int k = least; k + 1 < s.n; k++) {
                s.building[k] = s.building[k + 1];
            }
            s.n--;
        }
        s.building[s.n++] = i;
    }
    for (int k = 0; k < s.n; k++) {
        const struct report_building *b = &r->building[s.building[k]];
        for (int i = 0; i < b->n_floor; i++) {
            s.heights = s.heights && b->height[i] > 0;
        }
    }
    return s;
}

static void write_building(const struct selection *s, int k, FILE *to) {
    const struct report_building *b = &s->r->building[s->building[k]];
    double level = 0;
    fprintf(to, "$floors%d << EOD\n# level displacement acceleration\n0 0 NaN\n", k);
    for (int i = 0; i < b->n_floor; i++) {
        level += s->heights ? b->height[i] : 1;
        fprintf(to, "%.9g %.9g %.9g\n", level, b->peak[PEAK_DISPLACEMENT][i],
                b->peak[PEAK_ACCELERATION][i]);
    }
    fprintf(to, "EOD\n$storeys%d << EOD\n# level drift shear, both ends of each storey\n", k);
    level = 0;
    for (int i = 0; i < b->n_floor; i++) {
        const double height = s->heights ? b->height[i] : 1;
        const double drift = b->peak[PEAK_DRIFT][i] / (s->heights ? height / 100 : 1);
        fprintf(to, "%.9g %.9g %.9g\n%.9g %.9g %.9g\n", level, drift, b->peak[PEAK_SHEAR][i],
                level + height, drift, b->peak[PEAK_SHEAR][i]);
        level += height;
    }
    fprintf(to, "EOD\n");
}

static double panel_maximum(const struct selection *s, const struct panel *p) {
    double value = 0;
    for (int k = 0; k < s->n; k++) {
        const struct report_building *b = &s->r->building[s->building[k]];
        for (int i = 0; i < b->n_floor; i++) {
            const bool ratio = p->peak == PEAK_DRIFT && s->heights;
            value = fmax(value, b->peak[p->peak][i] / (ratio ? b->height[i] / 100 : 1));
        }
    }
    return value;
}

static double top_level(const struct selection *s) {
    double top = 0;
    for (int k = 0; k < s->n; k++) {
        const struct report_building *b = &s->r->building[s->building[k]];
        double level = 0;
        for (int i = 0; i < b->n_floor; i++) {
            level += s->heights ? b->height[i] : 1;
        }
        top = fmax(top, level);
    }
    return top;
}

static void write_panel(const struct selection *s, int at, FILE *to) {
    const struct panel *p = &panels[at];
    const double maximum = panel_maximum(s, p), step = script_step(maximum, 4);
    const double left = 0.085 + 0.23 * at;
    fprintf(to, "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", left, left + 0.19);
    fprintf(to, "set xrange [0:%.9g]\nset xtics %.9g\nset xlabel ",
            maximum > 0 ? 1.06 * maximum : 1, step);
    if (p->peak == PEAK_DRIFT && s->heights) {
        script_text(to, "drift / storey height [%]");
    } else {
        script_axis(to, p->name, &s->r->units, *p->dimension);
    }
    if (at == 1) {
        fprintf(to, "\nunset ylabel\nset format y ''");
    }
    fprintf(to, "\nplot \\\n");
    for (int k = 0; k < s->n; k++) {
        fprintf(to, "  $%s%d using %d:1 with %s lc rgb '%s' dt %d", p->data, k, p->column,
                p->data[0] == 'f' ? "linespoints pt 7 ps 0.6" : "lines",
                script_colour[k % SCRIPT_COLOURS], 1 + k / SCRIPT_COLOURS);
        fprintf(to, "%s", k + 1 < s->n ? ", \\\n" : "\n");
    }
    script_head_end(to);
}

static void write_titles(const struct selection *s, FILE *to) {
    const struct report *r = s->r;
    char text[160] = "largest absolute values over all computed steps";
    if (s->n < r->n_building) {
        snprintf(text, sizeof text,
                 "largest absolute values; %d of %d buildings: those with the largest drift", s->n,
                 r->n_building);
    }
    script_head(to, r->title[0] ? r->title : r->deck_file, text);
    for (int k = 0; k < s->n; k++) {
        script_legend(to, k, 1, k < SCRIPT_COLOURS ? SCRIPT_LINE : SCRIPT_DASHED,
                      script_colour[k % SCRIPT_COLOURS], r->building[s->building[k]].name);
    }
}

static int draw(const struct result_file *file, FILE *to, struct error *e) {
    (void)e;
    const struct selection s = choose(result_report(file));
    for (int k = 0; k < s.n; k++) {
        write_building(&s, k, to);
    }
    write_titles(&s, to);
    const double top = top_level(&s);
    const double step = script_step(top, 10);
    fprintf(to,
            "set multiplot\nset tmargin at screen 0.82\nset bmargin at screen 0.115\n"
            "set yrange [0:%.9g]\nset ytics %.9g\nset format x '%%g'\nset ylabel ",
            1.02 * top, s.heights || step > 1 ? step : 1);
    if (s.heights) {
        script_axis(to, "height", &s.r->units, dimension_length);
    } else {
        script_text(to, "floor");
    }
    fprintf(to, "\n");
    for (int at = 0; at < PANELS; at++) {
        write_panel(&s, at, to);
    }
    fprintf(to, "unset multiplot\n");
    return STATUS_OK;
}

const struct figure figure_profiles = {
    .name = "profiles",
    .doc = "peak displacement, drift, acceleration and shear over the height",
    .draw = draw,
};
