// SPDX-License-Identifier: GPL-3.0-or-later
// Where things stand on the sheet: heads, legends, and panels with their axes. Lengths are in em,
// the height of a character, from the lower left corner, so that text fits at every size.
#ifndef JOSTLE_CANVAS_H
#define JOSTLE_CANVAS_H

#include <stdio.h>

#include "jostle/error.h"
#include "jostle/units.h"

// From the smallest to the largest of some values: what an axis shows.

struct span {
    double low, high;
};
// Widens `r` by a value, or by another span; values that are not finite, or beyond 1e300, are
// passed over, and those below 1e-300 are 0. Begin with span_none.
extern const struct span span_none;
void span_add(struct span *r, double value);
void span_join(struct span *r, struct span other);
// Some room at both ends, at `from` none; never empty. `from` is NAN where there is no such end.
struct span span_with_room(struct span r, double from);

// An upright rectangle [em].
struct area {
    double left, right, bottom, top;
};

// A whole sheet has a title; a block of the overview has a heading.
enum canvas_kind { CANVAS_SHEET, CANVAS_BLOCK };

struct canvas {
    FILE *to;    // the script; borrowed
    FILE *data;  // blocks of data, $NAME; borrowed. No two of a picture have one name
    enum canvas_kind kind;
    const struct unit_system *units;  // of the values shown; borrowed
    int status;                       // of the first failure; what follows it is not used
    struct error *e;                  // its message; borrowed
    int n_series;                     // of the panel that is open
    double width, height;             // of the sheet [em]
    struct area area;                 // what is left for the panels: heads and legends take from it
};

// Records a failure. Errors stick: the first one counts, and figure_close returns it. So figures go
// on after a failure, and read no more.
void canvas_fail(struct canvas *c, int status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Starts the block of data $NAME, of which `columns` says what is in it; and ends the block. The
// name has literals and numbers only, as check_script.sh demands.
void canvas_block(struct canvas *c, const char *columns, const char *name, ...)
    __attribute__((format(printf, 3, 4)));
void canvas_end(struct canvas *c);

// The title, on a sheet only, and a line that says what is shown. They are drawn with the first
// panel. Texts that do not fit are cut.
void canvas_head(struct canvas *c, const char *title, const char *text, ...)
    __attribute__((format(printf, 3, 4)));

// The part of the area between the fractions x0 to x1 of its width and y0 to y1 of its height.
struct area canvas_part(const struct canvas *c, double x0, double x1, double y0, double y1);

// True if `n` points above each other in the area do not make a thick line.
bool canvas_has_room(const struct canvas *c, int n);

// Room for the texts at the axes within an area [em].
struct area canvas_inset(struct area a, double left, double right, double bottom, double top);

enum axis_kind { AXIS_FULL, AXIS_WITHOUT_NUMBERS, AXIS_LOGARITHMIC };
struct axis {
    const char *name;   // NULL: none
    const char *brief;  // in its place on an axis across that is too short for it; NULL: the name
    const char *unit;   // in place of `dimension`; "": a number
    struct dimension dimension;
    struct span span;
    struct span scale;  // numbers have the power of ten that these need; empty: those of `span`
    enum axis_kind kind;
    double step;  // between tics at least; 0: any
};

// Axes at the sides of `a`. Nothing is left of the scales of panels before.
void canvas_axes(const struct canvas *c, struct area a, const struct axis *x, const struct axis *y);

// The command for a label without its place; what is wider than `width` em is cut.
void canvas_label(const struct canvas *c, const char *text, double width);

// " at screen X,Y" of a label at a point in em.
void canvas_place(const struct canvas *c, double x, double y);

// The name of an upright axis beside `a`, for several panels above each other. Where there is no
// room, the unit takes a second line, and one of it in g a third.
void canvas_upright(const struct canvas *c, struct area a, const struct axis *axis);

#endif
