// SPDX-License-Identifier: GPL-3.0-or-later
// An end of a link is drawn at the face of its building that looks to the other end. A rigid wall
// stands in the gap. Several links between the same two points stand above each other.
#include "plot/deck_links.h"

#include <math.h>
#include <stdlib.h>

#include "model/struck_column.h"
#include "plot/script.h"

static const double WALL_WIDTH = 0.7, BETWEEN = 0.45, LABEL = 0.55;  // [em]
static const double INSIDE[] = {0.2, 0.8};  // ends of a link within a building, as shares of it

void deck_put_line(struct deck_shapes *s, double x0, double y0, double x1, double y1) {
    s->n++;
    if (s->to) {
        fprintf(s->to, "%.6g %.7g\n%.6g %.7g\n\n", x0, y0, x1, y1);
    }
}

void deck_put_box(struct deck_shapes *s, double x0, double x1, double y0, double y1) {
    s->n++;
    if (s->to) {
        fprintf(s->to, "%.6g %.7g\n%.6g %.7g\n%.6g %.7g\n%.6g %.7g\n\n", x0, y0, x1, y0, x1, y1, x0,
                y1);
    }
}

void deck_put_point(struct deck_shapes *s, double x, double y) {
    s->n++;
    if (s->to) {
        fprintf(s->to, "%.6g %.7g\n", x, y);
    }
}

// The building of an end, or WALL.
static int host(const struct deck_view *v, const struct link *l, int side) {
    return struck_column_host(v->m, l->building[l->within ? 0 : side]);
}

static bool is_shown(const struct deck_view *v, const struct link *l) {
    return host(v, l, 0) < v->at.n && host(v, l, 1) < v->at.n;
}

// The gap that a link bridges: that left of building k is number k. Below 0: several.
static int gap_of(const struct deck_view *v, const struct link *l) {
    const int left = host(v, l, 0), right = host(v, l, 1);
    if (l->within) {
        return -1;
    }
    if (left == WALL || right == WALL) {
        return left == WALL ? right : left + 1;
    }
    return abs(right - left) == 1 ? (left > right ? left : right) : -1;
}

static double level_of(const struct deck_view *v, const struct link *l, int side) {
    const int building = host(v, l, side);
    if (building == WALL) {
        return level_of(v, l, 1 - side);
    }
    const int column = l->column[side];
    const double level = column >= 0 ? v->m->column[column].level : l->level[side];
    const int floor = column >= 0 ? v->m->column[column].floor : l->floor[side];
    return elevation_between(&v->at, building, floor, level);
}

static double place_of(const struct deck_view *v, const struct link *l, int side) {
    const int building = host(v, l, side), other = host(v, l, 1 - side);
    if (l->within) {
        return elevation_x(&v->at, building, INSIDE[side]);
    }
    if (building == WALL) {
        const double half = WALL_WIDTH / 2;
        return elevation_gap(&v->at, gap_of(v, l)) + (side == 0 ? half : -half);
    }
    const bool looks_right = other == WALL ? side == 0 : other > building;
    return elevation_x(&v->at, building, looks_right ? 1 : 0);
}

static bool same_ends(const struct link *a, const struct link *b) {
    bool same = a->within == b->within;
    for (int i = 0; i < 2; i++) {
        same = same && a->building[i] == b->building[i] && a->floor[i] == b->floor[i] &&
               (a->level[i] == b->level[i] || (isnan(a->level[i]) && isnan(b->level[i])));
    }
    return same;
}

// How far above its place a link is drawn, because others have the same ends.
static double raised(const struct deck_view *v, int number) {
    int n = 0;
    for (int i = 0; i < number; i++) {
        n += same_ends(&v->m->link[i], &v->m->link[number]);
    }
    return n > 0 ? n * BETWEEN * elevation_per_em(&v->at) : 0;
}

static void write_links(const struct deck_view *v, int first, int end, struct deck_shapes *s) {
    for (int i = first; i < end; i++) {
        const struct link *l = &v->m->link[i];
        if (is_shown(v, l)) {
            const double up = raised(v, i);
            deck_put_line(s, place_of(v, l, 0), level_of(v, l, 0) + up, place_of(v, l, 1),
                          level_of(v, l, 1) + up);
        }
    }
}

// All contacts and all links are drawn with the first building.
void deck_links_write_contacts(const struct deck_view *v, int k, struct deck_shapes *s) {
    write_links(v, 0, k == 0 ? v->m->n_contact : 0, s);
}

void deck_links_write_links(const struct deck_view *v, int k, struct deck_shapes *s) {
    write_links(v, v->m->n_contact, k == 0 ? v->m->n_link - v->m->n_column : 0, s);
}

// The place of a column: where a link ends on it, or at the right face.
static double column_place(const struct deck_view *v, int column) {
    for (int i = 0; i < v->m->n_link - v->m->n_column; i++) {
        const struct link *l = &v->m->link[i];
        for (int side = 0; side < 2; side++) {
            if (l->column[side] == column && is_shown(v, l)) {
                return place_of(v, l, side);
            }
        }
    }
    return elevation_x(&v->at, v->m->column[column].building, 1);
}

void deck_links_write_struck(const struct deck_view *v, int k, struct deck_shapes *s) {
    for (int i = 0; i < v->m->n_column; i++) {
        const struct struck_column *c = &v->m->column[i];
        if (c->building == k) {
            const double x = column_place(v, i);
            deck_put_line(s, x, elevation_level(&v->at, k, c->floor - 1), x,
                          elevation_level(&v->at, k, c->floor));
        }
    }
}

// The rigid wall in a gap, up to its highest contact.
static void write_rigid(const struct deck_view *v, int gap, struct deck_shapes *s) {
    double top = -INFINITY;
    for (int i = 0; i < v->m->n_link; i++) {
        const struct link *l = &v->m->link[i];
        const bool rigid = !l->within && (host(v, l, 0) == WALL || host(v, l, 1) == WALL);
        if (rigid && is_shown(v, l) && gap_of(v, l) == gap) {
            top = fmax(fmax(top, 0), level_of(v, l, 0) + raised(v, i));
        }
    }
    if (top >= 0) {
        const double x = elevation_gap(&v->at, gap);
        deck_put_box(s, x - WALL_WIDTH / 2, x + WALL_WIDTH / 2, 0, top + elevation_per_em(&v->at));
    }
}

void deck_links_write_rigid(const struct deck_view *v, int k, struct deck_shapes *s) {
    write_rigid(v, k, s);
    if (k + 1 == v->at.n) {
        write_rigid(v, v->at.n, s);  // right of the last building
    }
}

// Each gap at its contact. Labels that would stand in each other are left out.
static void write_each(const struct deck_view *v, struct canvas *c, int gap) {
    const double em = elevation_per_em(&v->at), room = 0.42 * v->at.slot;
    double before = -INFINITY;
    for (int i = 0; i < v->m->n_contact; i++) {
        const struct link *l = &v->m->link[i];
        if (!is_shown(v, l) || gap_of(v, l) != gap) {
            continue;
        }
        const double y = (level_of(v, l, 0) + level_of(v, l, 1)) / 2 + raised(v, i);
        char text[32];
        script_number(l->gap, text, sizeof text);
        if (fabs(y - before) > em && 0.75 * script_width(text) < room) {
            elevation_text(&v->at, c, text, (place_of(v, l, 0) + place_of(v, l, 1)) / 2,
                           y + LABEL * em, room);
            before = y;
        }
    }
}

void deck_links_write_gaps(const struct deck_view *v, struct canvas *c, int line) {
    for (int gap = 0; gap <= v->at.n; gap++) {
        struct span span = span_none;
        for (int i = 0; i < v->m->n_contact; i++) {
            const struct link *l = &v->m->link[i];
            if (is_shown(v, l) && gap_of(v, l) == gap) {
                span_add(&span, l->gap);
            }
        }
        if (span.low == span.high) {
            elevation_number(&v->at, c, span.low, elevation_gap(&v->at, gap), line);
        } else if (span.low < span.high) {
            char low[32], high[32], text[80];
            script_number(span.low, low, sizeof low);
            script_number(span.high, high, sizeof high);
            snprintf(text, sizeof text, "%s to %s", low, high);
            elevation_below(&v->at, c, text, elevation_gap(&v->at, gap), line, 0.96 * v->at.slot);
            write_each(v, c, gap);
        }
    }
    write_each(v, c, -1);  // contacts beyond a neighbour
}
