// SPDX-License-Identifier: GPL-3.0-or-later
// A map along a row of buildings: storeys in the colours of their largest drifts, points at the
// contacts that have closed, and below them the largest contact force in each gap. Buildings stand
// beside each other in the order of the deck; only heights are to scale.
#include <math.h>

#include "plot/figure.h"
#include "plot/panel.h"

enum { NAMES_MAX = 24 };  // more buildings have numbers at the axis

static const double HALF = 0.45;      // of a building, of the distance between two
static const double MAP_SHARE = 0.6;  // of the height

struct street {
    const struct report *r;
    bool heights;  // all storeys have them
    double top;    // of the highest building
    double drift;  // the largest
    double force;  // the largest of a contact
    long n_hit;    // contacts that have closed
};

// NAN: a free body has no storey.
static double drift_of(const struct street *s, const struct report_building *b, int i) {
    if (b->stiffness[i] == 0) {
        return NAN;
    }
    return b->peak[PEAK_DRIFT][i] / (s->heights ? b->height[i] / 100.0 : 1.0);
}

static bool has_closed(const struct report_link *c) {
    return c->peak.impacts > 0;
}

// The gap of a contact: that before building i, from 0. A wall is at the free side of a building.
static int gap_of(const struct report *r, const struct report_link *c) {
    const int left = runs_building(r, c->left), right = runs_building(r, c->right);
    return left < 0 ? right : right < 0 ? left + 1 : left < right ? right : left;
}

static double level_of(const struct street *s, const struct report_link *c) {
    const int left = runs_building(s->r, c->left);
    const struct report_building *b =
        &s->r->building[left >= 0 ? left : runs_building(s->r, c->right)];
    const double between = left >= 0 ? c->left_level : c->right_level;
    return isnan(between) ? runs_level(b, left >= 0 ? c->left_floor : c->right_floor, s->heights)
                          : between;
}

static void survey(struct street *s) {
    s->heights = true;
    for (int k = 0; k < s->r->n_building; k++) {
        s->heights = s->heights && runs_has_heights(&s->r->building[k]);
    }
    for (int k = 0; k < s->r->n_building; k++) {
        const struct report_building *b = &s->r->building[k];
        s->top = fmax(s->top, runs_level(b, b->n_floor, s->heights));
        for (int i = 0; i < b->n_floor; i++) {
            s->drift = fmax(s->drift, drift_of(s, b, i));
        }
    }
    for (int i = 0; i < s->r->n_contact; i++) {
        const struct report_link *c = &s->r->contact[i];
        s->force = fmax(s->force, c->peak.force);
        s->n_hit += has_closed(c);
    }
}

static void write_storeys(const struct street *s, struct canvas *c) {
    canvas_block(c, "building, level, left, right, bottom, top, drift", "storeys");
    for (int k = 0; k < s->r->n_building; k++) {
        const struct report_building *b = &s->r->building[k];
        for (int i = 0; i < b->n_floor; i++) {
            const double low = runs_level(b, i, s->heights);
            const double high = runs_level(b, i + 1, s->heights);
            fprintf(c->data, "%d %.7g %.7g %.7g %.7g %.7g %.7g\n", k + 1, (low + high) / 2,
                    k + 1 - HALF, k + 1 + HALF, low, high, drift_of(s, b, i));
        }
    }
    canvas_end(c);
}

// Of the lines in one gap the longest is seen.
static void write_contacts(const struct street *s, struct canvas *c) {
    canvas_block(c, "gap, level of a contact that has closed, largest force", "contacts");
    fprintf(c->data, "NaN NaN NaN\n");
    for (int i = 0; i < s->r->n_contact; i++) {
        const struct report_link *l = &s->r->contact[i];
        fprintf(c->data, "%.7g %.7g %.9g\n", gap_of(s->r, l) + 0.5,
                has_closed(l) ? level_of(s, l) : (double)NAN, l->peak.force);
    }
    canvas_end(c);
}

static void write_names(const struct street *s, double room, const struct canvas *c) {
    fprintf(c->to, "set xtics (");
    for (int k = 0; k < s->r->n_building; k++) {
        panel_tic(c, k, s->r->building[k].name, room, k + 1);
    }
    fprintf(c->to, ")\n");
}

static void write_head(const struct street *s, const struct runs *runs, struct canvas *c) {
    canvas_head(c, runs->title, "%d buildings; %ld of %d contacts have closed", s->r->n_building,
                s->n_hit, s->r->n_contact);
    struct legend l = {0};
    legend_add(&l, panel_points("#0072b2", POINT_DISC, 0.8), "contacts that have closed", "");
    legend_add(&l, panel_line("#0072b2", 2), "largest contact force in each gap", "");
    legend_write(&l, c);
}

static void draw_map(const struct street *s, struct area a, const struct axis *x,
                     struct canvas *c) {
    const double scale = 7.5;  // [em] for the scale of drifts
    const double most = s->drift > 0 ? s->drift : 1;
    a.right -= scale;
    struct axis across = *x;
    across.name = NULL;
    across.kind = AXIS_WITHOUT_NUMBERS;
    panel_open(c, &(struct panel){
                      .area = a, .x = across, .y = runs_height_axis(true, s->heights, s->top)});
    panel_shades(c, SHADES_LINES, most);
    panel_series(c, (struct style){.kind = STYLE_BOXES}, "$storeys using 1:2:3:4:5:6:7");
    const double size = s->r->n_building > 2 * NAMES_MAX ? 0.35 : 0.8;
    panel_series(c, panel_points("#0072b2", POINT_DISC, size), "$contacts using 1:2");
    panel_close(c);
    const struct axis drift = {.name = s->heights ? "drift / height" : "storey drift",
                               .unit = s->heights ? "%" : NULL,
                               .dimension = dimension_length,
                               .span = {0, most}};
    panel_shades_scale(c, (struct area){a.right + 6, a.right + 7.2, a.bottom, a.top}, &drift);
}

static void draw(const struct subject *subject, struct canvas *c) {
    struct street s = {.r = subject->runs->r[0]};
    survey(&s);
    write_storeys(&s, c);
    write_contacts(&s, c);
    write_head(&s, subject->runs, c);
    const bool names = s.r->n_building <= NAMES_MAX;
    const struct axis x = {.name = names ? NULL : "building, from the left",
                           .unit = "",
                           .span = {0.4, s.r->n_building + 0.6}};
    const struct area map = canvas_inset(canvas_part(c, 0, 1, 1 - MAP_SHARE, 1), 5.5, 1, 1, 0.5);
    draw_map(&s, map, &x, c);
    const struct area a = canvas_inset(canvas_part(c, 0, 1, 0, 1 - MAP_SHARE), 5.5, 8.5, 3.2, 0.5);
    panel_open(c, &(struct panel){.area = a,
                                  .x = x,
                                  .y = {.name = "force",
                                        .dimension = dimension_force,
                                        .span = span_with_room((struct span){0, s.force}, 0)}});
    if (names) {
        write_names(&s, (a.right - a.left) / (s.r->n_building + 0.2), c);
    }
    panel_series(c, (struct style){.kind = STYLE_UPRIGHT, .colour = "#0072b2", .width = 2},
                 "$contacts using 1:3");
    panel_close(c);
}

static int check(const struct subject *p, struct error *e) {
    return p->runs->n > 1 ? error_set(e, STATUS_INPUT, "it shows one run, not two") : STATUS_OK;
}

const struct figure figure_street = {
    .name = "street",
    .doc = "a map along a row of buildings: drifts, contacts that have closed, forces",
    .check = check,
    .draw = draw,
};
