// SPDX-License-Identifier: GPL-3.0-or-later
// A panel of a picture: axes with texts around them, and series of data within.
#ifndef JOSTLE_PANEL_H
#define JOSTLE_PANEL_H

#include "plot/canvas.h"

struct panel {
    struct area area;  // the axes stand at its sides
    struct axis x, y;
    const char *caption, *tail;  // above it; a long caption loses its middle; NULL: none
    const char *note;            // in the middle: why the panel is empty; NULL: it is not
};

// How a series of data is drawn.
enum style_kind {
    STYLE_LINE,
    STYLE_AREA,        // between two curves
    STYLE_AREA_BELOW,  // between two curves, where the first one is below the second
    STYLE_POINTS,
    STYLE_BOTH,     // a line with points
    STYLE_UPRIGHT,  // an upright line from 0 to each value
    STYLE_VECTOR,   // a line from a point by a distance
    STYLE_SHADED,   // the same in the colour of its value
    STYLE_BARS,     // upright bars between two values
    STYLE_BOXES,    // boxes whose colours are those of the palette
};
// Points by gnuplot's numbers, which mean the same on all terminals used.
enum style_point { POINT_CROSS = 2, POINT_RING = 6, POINT_DISC = 7 };
// The look of a series, and of its sample in the legend.
struct style {
    enum style_kind kind;
    const char *colour;
    double width;      // of lines; 0: as usual
    const char *dash;  // "(10,6)" or "solid"; NULL: none
    int point;         // enum style_point, or of script_point; 0: a disc, on a line none
    double size;       // of points; 0: as usual; below 0: the third column has it
};

struct style panel_line(const char *colour, double width);
struct style panel_area(const char *colour);
struct style panel_points(const char *colour, int point, double size);

// Draws the axes and texts of a panel. Other commands for it, such as tics with names, follow
// before its first series.
void panel_open(struct canvas *c, const struct panel *p);

// Tic number `i`, from 0, of those between "set xtics (" and ")": a name at the place, cut where it
// is wider than `width` em.
void panel_tic(const struct canvas *c, int i, const char *name, double width, int place);

// Draws a series over those before it. `data` is the format of a data block and its columns, such
// as
// "$rows%d using 1:2"; its arguments are literals and numbers, as check_script.sh demands.
void panel_series(struct canvas *c, struct style s, const char *data, ...)
    __attribute__((format(printf, 3, 4)));

// An upright line across the panel at x, before its first series.
void panel_upright(const struct canvas *c, double x, struct style s);

// Ends the panel. It must have a series.
void panel_close(struct canvas *c);

// Colours of areas, the highest value light; and of lines on white, the highest value dark.
enum shades { SHADES_AREAS, SHADES_LINES };

// Sets the colours of values from 0 to `most` > 0, in a panel that is open.
void panel_shades(const struct canvas *c, enum shades shades, double most);

// Draws the scale as a panel of its own; `axis` spans from 0 to `most`.
void panel_shades_scale(struct canvas *c, struct area a, const struct axis *axis);

#endif
