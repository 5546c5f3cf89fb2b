// SPDX-License-Identifier: GPL-3.0-or-later
// Buildings side by side on one panel, seen from the front: heights to scale, widths schematic.
// The horizontal axis of the panel counts em from its left side.
#ifndef JOSTLE_ELEVATION_H
#define JOSTLE_ELEVATION_H

#include <stdbool.h>

#include "model/frame.h"
#include "plot/panel.h"

enum { ELEVATION_MAX = 16 };  // buildings

struct elevation_building {
    const char *name;
    int n_floor;
    const double *height;  // [L] (n_floor) of the storeys; NULL: not given
};

struct elevation {
    int n;
    struct elevation_building building[ELEVATION_MAX];
    bool heights;    // all have them; else storeys are 1 high
    double top;      // the highest roof
    double slot;     // [em] for a building and half of the gaps beside it
    double left;     // [em] of the first slot
    struct span at;  // what the upright axis shows
    struct area area;
};

// Adds a building; false if there is no room for more.
bool elevation_add(struct elevation *e, const struct elevation_building *b);

// Places the buildings into the area, with room below it for so many lines of texts, and opens the
// panel.
void elevation_open(struct elevation *e, struct canvas *c, int n_line);

// A horizontal place [em] in building k, which is 0 at its left side and 1 at its right side; and
// the middle of the gap left of building k, of which there are n + 1.
double elevation_x(const struct elevation *e, int k, double share);
double elevation_gap(const struct elevation *e, int k);

// Of a floor of building k (0: the ground), or of a level [L] in the storey below it.
double elevation_level(const struct elevation *e, int k, int floor);
double elevation_between(const struct elevation *e, int k, int floor, double level);

// The ends of a member of a frame of n lines, or of one of n walls.
struct elevation_ends {
    double x[2], y[2];
};
struct elevation_ends elevation_member(const struct elevation *e, int k, enum frame_kind kind,
                                       int level, int number, int n);

// How many units of the upright axis are one em.
double elevation_per_em(const struct elevation *e);

// A small text in the middle of a place of the panel, or in a line below it (from 0), on at most
// `width` em; a number there, with as many of four digits as a slot has room for; whether a text
// fits there; and the name of such a line, left of the panel.
void elevation_text(const struct elevation *e, const struct canvas *c, const char *text, double x,
                    double y, double width);
void elevation_below(const struct elevation *e, const struct canvas *c, const char *text, double x,
                     int line, double width);
void elevation_number(const struct elevation *e, const struct canvas *c, double value, double x,
                      int line);
bool elevation_fits(const struct elevation *e, const char *text);
void elevation_line(const struct elevation *e, const struct canvas *c, const char *text, int line);

// The name of a building, in a line below the panel; the numbers of its floors and the level of its
// roof, where there is room.
void elevation_name(const struct elevation *e, const struct canvas *c, int k, int line);

#endif
