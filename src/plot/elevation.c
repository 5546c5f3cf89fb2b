// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot/elevation.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "model/pairs.h"
#include "plot/script.h"

// [em], shares of a slot, and of the height.
static const double MARGIN = 7.5, SLOT_MAX = 14, LINE = 1.15, SMALL = 0.75;
static const double WIDTH = 0.56;            // of a building
static const double ROOM = 0.96;             // for a text below it
static const double WALLS[] = {0.38, 0.62};  // shares of a building
static const double BELOW_GROUND = 0.05, ABOVE_ROOF = 0.08;

bool elevation_add(struct elevation *e, const struct elevation_building *b) {
    if (e->n == ELEVATION_MAX) {
        return false;
    }
    e->heights = (e->n == 0 || e->heights) && b->height;
    e->building[e->n++] = *b;
    return true;
}

double elevation_level(const struct elevation *e, int k, int floor) {
    const struct elevation_building *b = &e->building[k];
    assert(k >= 0 && k < e->n && floor >= 0 && floor <= b->n_floor);
    return e->heights ? level_of_floor(b->height, floor) : floor;
}

double elevation_between(const struct elevation *e, int k, int floor, double level) {
    const double *height = e->building[k].height;
    if (isnan(level) || e->heights) {
        return isnan(level) ? elevation_level(e, k, floor) : level;
    }
    return floor - 1 + (level - level_of_floor(height, floor - 1)) / height[floor - 1];
}

double elevation_x(const struct elevation *e, int k, double share) {
    return e->left + e->slot * (k + 0.5 + WIDTH * (share - 0.5));
}

double elevation_gap(const struct elevation *e, int k) {
    return e->left + e->slot * k;
}

struct elevation_ends elevation_member(const struct elevation *e, int k, enum frame_kind kind,
                                       int level, int number, int n) {
    struct elevation_ends at;
    const int last = n > 1 ? n - 1 : 1;
    for (int end = 0; end < 2; end++) {
        const int line = number - 1 + (kind == FRAME_BEAM ? end : 0);
        const double share = kind == FRAME_WALL ? WALLS[0] + (WALLS[1] - WALLS[0]) * line / last
                             : n > 1            ? (double)line / last
                                                : 0.5;
        at.x[end] = elevation_x(e, k, share);
        at.y[end] = elevation_level(e, k, kind == FRAME_BEAM ? level : level - 1 + end);
    }
    return at;
}

double elevation_per_em(const struct elevation *e) {
    return (e->at.high - e->at.low) / (e->area.top - e->area.bottom);
}

void elevation_open(struct elevation *e, struct canvas *c, int n_line) {
    assert(e->n > 0);
    for (int k = 0; k < e->n; k++) {
        e->top = fmax(e->top, elevation_level(e, k, e->building[k].n_floor));
    }
    e->area = canvas_inset(c->area, MARGIN, 0.5, LINE * n_line + 0.4, 0.5);
    const double width = e->area.right - e->area.left;
    e->slot = fmin(SLOT_MAX, width / (e->n + 0.4));
    e->left = (width - e->n * e->slot) / 2;
    e->at = (struct span){-BELOW_GROUND * e->top, (1 + ABOVE_ROOF) * e->top};
    panel_open(c, &(struct panel){
                      .area = e->area,
                      .x = {.span = {0, width}, .kind = AXIS_WITHOUT_NUMBERS, .step = 1},
                      .y = {.name = e->heights ? "height" : "floor",
                            .unit = e->heights ? NULL : "",
                            .dimension = dimension_length,
                            .span = e->at,
                            .step = e->heights ? 0 : 1},
                  });
    fprintf(c->to, "unset xtics\nset grid noxtics\n");
}

static void small_label(const struct canvas *c, const char *text, double x, double y,
                        double width) {
    char cut[128];
    script_shorten(text, width / SMALL, cut, sizeof cut);
    canvas_label(c, cut, INFINITY);
    canvas_place(c, x, y);
}

void elevation_text(const struct elevation *e, const struct canvas *c, const char *text, double x,
                    double y, double width) {
    small_label(c, text, e->area.left + x, e->area.bottom + (y - e->at.low) / elevation_per_em(e),
                width);
    fprintf(c->to, " center font small_font\n");
}

static double line_of(const struct elevation *e, int line) {
    return e->area.bottom - LINE * (line + 0.7);
}

void elevation_below(const struct elevation *e, const struct canvas *c, const char *text, double x,
                     int line, double width) {
    small_label(c, text, e->area.left + x, line_of(e, line), width);
    fprintf(c->to, " center font small_font\n");
}

void elevation_line(const struct elevation *e, const struct canvas *c, const char *text, int line) {
    small_label(c, text, e->area.left - 0.4, line_of(e, line), MARGIN);
    fprintf(c->to, " right font small_font textcolor rgb '#606060'\n");
}

bool elevation_fits(const struct elevation *e, const char *text) {
    return SMALL * script_width(text) <= ROOM * e->slot;
}

void elevation_number(const struct elevation *e, const struct canvas *c, double value, double x,
                      int line) {
    char text[48];
    script_number(value, text, sizeof text);
    for (int digits = 3; digits > 0 && !elevation_fits(e, text); digits--) {
        snprintf(text, sizeof text, "%.*g", digits, value);
    }
    elevation_below(e, c, text, x, line, ROOM * e->slot);
}

void elevation_name(const struct elevation *e, const struct canvas *c, int k, int line) {
    const int n = e->building[k].n_floor;
    const double em = elevation_per_em(e), roof = elevation_level(e, k, n);
    const double middle = elevation_x(e, k, 0.5);
    const bool level = e->heights && e->slot > 2.5, narrow = e->slot < 6;
    char text[48];
    elevation_below(e, c, e->building[k].name, middle, line, ROOM * e->slot);
    for (int i = 1; n > 1 && i <= n - (level && narrow) && roof > n * em && e->slot > 2.5; i++) {
        snprintf(text, sizeof text, "%d", i);
        elevation_text(e, c, text, elevation_x(e, k, 0) + 0.5 + 0.2 * (i > 9),
                       elevation_level(e, k, i) + 0.45 * em, INFINITY);
    }
    if (level) {
        script_number(roof, text, sizeof text);
        elevation_text(e, c, text, middle, roof + 0.7 * em, e->slot);
    }
}
