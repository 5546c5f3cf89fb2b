// SPDX-License-Identifier: GPL-3.0-or-later
// Every impact at its time and floor, the larger the harder. Each pair of neighbours has a band of
// its own, the bands stand above each other from left to right of the row. Where some impact has no
// force, impulses are shown.
#include <math.h>
#include <string.h>

#include "core/safe.h"
#include "plot/figure.h"
#include "plot/panel.h"
#include "plot/script.h"

// Of many impacts the hardest of each of PARTS parts of the duration are kept, for each contact.
enum { BANDS_MAX = 24, PARTS = 300 };

// The contacts between the same two neighbours.
struct band {
    const char *left, *right;
    int low, high;  // floors
    double base;    // place of floor 0 on the axis
    long impacts;   // of the first run
};

struct view {
    const struct runs *s;
    struct band band[BANDS_MAX];
    int n;
    double top;      // of the axis
    double largest;  // force or impulse
    bool impulse;
    bool more;  // pairs than bands
};

static int check(const struct subject *p, struct error *e) {
    return p->runs->r[0]->n_contact > 0 ? STATUS_OK : runs_lack_contacts(p->runs, e);
}

static int floor_of(const struct report_link *c) {
    return c->left_floor > 0 ? c->left_floor : c->right_floor;
}

static int band_of(const struct view *v, const struct report_link *c) {
    int b = 0;
    while (b < v->n &&
           (strcmp(v->band[b].left, c->left) != 0 || strcmp(v->band[b].right, c->right) != 0)) {
        b++;
    }
    return b;
}

static void collect(struct view *v) {
    const struct report *r = v->s->r[0];
    for (int i = 0; i < r->n_contact; i++) {
        const struct report_link *c = &r->contact[i];
        const int b = band_of(v, c), floor = floor_of(c);
        if (b == BANDS_MAX) {
            v->more = true;
            continue;
        }
        struct band *band = &v->band[b];
        if (b == v->n) {
            *band = (struct band){.left = c->left, .right = c->right, .low = floor, .high = floor};
            v->n++;
        }
        band->low = floor < band->low ? floor : band->low;
        band->high = floor > band->high ? floor : band->high;
        band->impacts += c->peak.impacts;
    }
    for (int b = 0; b < v->n; b++) {
        struct band *band = &v->band[b];
        const double room = fmax(0.8, 0.1 * (band->high - band->low));
        band->base = v->top + room - band->low;
        v->top = band->base + band->high + room;
    }
}

static double size_of(const struct view *v, const struct impact *p) {
    return v->impulse ? p->impulse : p->peak_force;
}

// Area goes with the force. Where floors are close together all points are smaller.
static double point_size(const struct view *v, double size) {
    const double most = fmin(4, fmax(1.3, 60 / v->top));
    return 0.4 + most * sqrt(size / v->largest);
}

static void write_impact(const struct view *v, const struct report *r, long i, FILE *to) {
    const struct impact *p = &r->impact[i];
    const struct report_link *c = &r->contact[p->contact];
    const int b = band_of(v, c);
    if (b < v->n) {
        fprintf(to, "%.7g %.7g %.4g %.7g %d\n", p->t_start, v->band[b].base + floor_of(c),
                point_size(v, size_of(v, p)), size_of(v, p), floor_of(c));
    }
}

static void write_data(const struct view *v, int run, struct canvas *c) {
    const struct report *r = v->s->r[run];
    long hardest[PARTS];
    canvas_block(c, v->impulse ? "time place size impulse floor" : "time place size force floor",
                 "impacts%d", run);
    fputs("NaN NaN NaN NaN NaN\n", c->data);
    for (int contact = 0; contact < r->n_contact; contact++) {
        runs_hardest_of_parts(r, contact, PARTS, hardest);
        for (int k = 0; k < PARTS; k++) {
            if (hardest[k] >= 0) {
                write_impact(v, r, hardest[k], c->data);
            }
        }
    }
    canvas_end(c);
}

static void band_name(const struct band *band, char *text, size_t size) {
    char left[64], right[64];
    script_shorten(band->left, 6.5, left, sizeof left);
    script_shorten(band->right, 6.5, right, sizeof right);
    snprintf(text, size, "%s | %s: %ld", left, right, band->impacts);
}

// Room for the names of the bands [em].
static double names_width(const struct view *v) {
    double most = 0;
    for (int b = 0; b < v->n && v->n > 1; b++) {
        char text[160];
        band_name(&v->band[b], text, sizeof text);
        most = fmax(most, script_width(text));
    }
    return most > 0 ? 0.75 * most + 1.2 : 0.5;
}

static void write_names(const struct view *v, double em, FILE *to) {
    double at[BANDS_MAX];
    // Each name stands beside the middle of its band, or as near as possible without touching the
    // next name. `line` is the height of a name on the axis.
    double line = 0.8 / em;
    for (int b = 0; b < v->n; b++) {
        const struct band *band = &v->band[b];
        at[b] = band->base + (band->low + band->high) / 2.0;
        at[b] = b > 0 ? fmax(at[b], at[b - 1] + line) : at[b];
    }
    for (int b = v->n - 1; b >= 0; b--) {
        at[b] = fmin(at[b], b + 1 < v->n ? at[b + 1] - line : v->top - line / 2);
    }
    for (int b = 0; b < v->n; b++) {
        const struct band *band = &v->band[b];
        char text[160];
        band_name(band, text, sizeof text);
        fprintf(to, "set label ");
        safe_put(to, SAFE_GNUPLOT, text);
        fprintf(to, " at graph 1, first %.7g left offset 0.8,0 font small_font\n", at[b]);
        if (b > 0) {
            const struct band *below = &v->band[b - 1];
            const double edge = (below->base + below->high + band->base + band->low) / 2;
            fprintf(to,
                    "set arrow from graph 0, first %.7g to graph 1, first %.7g nohead lc rgb "
                    "'#404040' lw 0.6\n",
                    edge, edge);
        }
    }
}

static void draw_panel(const struct view *v, struct canvas *c) {
    const struct area a = canvas_inset(c->area, 4.8, names_width(v), 3.2, 0.7);
    const double em = (a.top - a.bottom) / v->top;  // of one floor
    panel_open(c, &(struct panel){.area = a,
                                  .x = runs_time_axis(v->s, true),
                                  .y = {.name = "floor", .unit = "", .span = {0, v->top}}});
    // Numbers of the floors in each band, as far as they find room; `em` of one floor.
    const int step = (int)ceil(1.3 / em);
    const char *before = "set ytics (";
    double below = -INFINITY;
    for (int b = 0; b < v->n; b++) {
        const struct band *band = &v->band[b];
        const double top = band->base + band->high;
        for (int floor = band->high; floor >= band->low; floor -= step) {
            const double room = (band->base + floor - below) * em;
            if (room > (floor == band->high ? 0.9 : 1.3)) {
                fprintf(c->to, "%s'%d' %.7g", before, floor, band->base + floor);
                before = ", ";
            }
        }
        below = (top - below) * em > 0.9 ? top : below;
    }
    fprintf(c->to, ")\n");
    if (v->n > 1) {
        write_names(v, em, c->to);
    }
    for (int k = 0; k < v->s->n; k++) {
        panel_series(c,
                     panel_points(k > 0 ? script_colour[1] : "#700072b2",
                                  k > 0 ? POINT_RING : POINT_DISC, -1),
                     "$impacts%d using 1:2:($3*point)", k);
    }
    panel_close(c);
}

// What the sizes of points stand for, in one power of ten.
static void add_sizes(const struct view *v, struct legend *l) {
    char text[160], unit[64], power[32] = "";
    const double step = script_step(v->largest, 2);
    const double shown[] = {step / 10, step / 2, step};
    const int exponent = script_exponent(step, 0.05, 1e6);
    if (exponent != 0) {
        script_power(exponent, power, sizeof power);
    }
    script_unit(&v->s->r[0]->units, v->impulse ? dimension_impulse : dimension_force, unit,
                sizeof unit);
    for (size_t i = 0; i < 3 && v->largest > 0; i++) {
        snprintf(text, sizeof text, "%.6g%s%s %s", shown[i] / pow(10, exponent),
                 power[0] ? "\u00b7" : "", power, unit);
        legend_add(l, panel_points("#707070", POINT_DISC, point_size(v, shown[i])), text, "");
    }
}

static void write_title(const struct view *v, struct canvas *c) {
    const struct report *r = v->s->r[0];
    char left[64], right[64], part[64] = "";
    if (v->more) {
        snprintf(part, sizeof part, ", those of the first %d pairs are shown", BANDS_MAX);
    }
    if (v->s->n > 1) {
        canvas_head(c, v->s->title, "%ld and %ld impacts%s", r->n_impact, v->s->r[1]->n_impact,
                    part);
    } else if (v->n == 1) {
        script_shorten(v->band[0].left, 9, left, sizeof left);
        script_shorten(v->band[0].right, 9, right, sizeof right);
        canvas_head(c, v->s->title, "%ld impact%s between %s and %s", r->n_impact,
                    r->n_impact == 1 ? "" : "s", left, right);
    } else {
        canvas_head(c, v->s->title, "%ld impacts%s", r->n_impact,
                    v->more ? part : ", counted for each pair");
    }
}

static void write_legend(const struct view *v, struct canvas *c) {
    struct legend l = {0};
    for (int k = 0; k < v->s->n && v->s->n > 1; k++) {
        legend_add(&l, panel_points(script_colour[k], k > 0 ? POINT_RING : POINT_DISC, 2),
                   v->s->name[k], "");
    }
    add_sizes(v, &l);
    legend_write(&l, c);
}

static void draw(const struct subject *subject, struct canvas *c) {
    const struct runs *s = subject->runs;
    struct view v = {.s = s};
    collect(&v);
    // Finds the largest force; if an impact has no force, the largest impulse.
    double force = 0.0;
    double impulse = 0.0;
    for (int k = 0; k < v.s->n; k++) {
        for (long i = 0; i < v.s->r[k]->n_impact; i++) {
            const struct impact *p = &v.s->r[k]->impact[i];
            v.impulse |= isnan(p->peak_force);
            force = fmax(force, p->peak_force);
            impulse = fmax(impulse, p->impulse);
        }
    }
    v.largest = v.impulse ? impulse : force;
    for (int k = 0; k < s->n; k++) {
        write_data(&v, k, c);
    }
    write_title(&v, c);
    write_legend(&v, c);
    draw_panel(&v, c);
}

const struct figure figure_impacts = {
    .name = "impacts",
    .doc = "every impact at its time and floor, with an area proportional to its force",
    .check = check,
    .draw = draw,
};
