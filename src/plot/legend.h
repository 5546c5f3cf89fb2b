// SPDX-License-Identifier: GPL-3.0-or-later
// The legend of a picture, in lines below its head.
#ifndef JOSTLE_LEGEND_H
#define JOSTLE_LEGEND_H

#include "plot/canvas.h"

// What stands for the data.
enum mark_kind { MARK_LINE, MARK_DASHED, MARK_AREA, MARK_POINT };
// Points by gnuplot's numbers, which mean the same on all terminals used.
enum mark_point { POINT_CROSS = 2, POINT_RING = 6, POINT_DISC = 7 };
struct mark {
    enum mark_kind kind;
    const char *colour;
    double size;  // of points; 0: as usual
    int point;    // enum mark_point, or of script_point; 0: a disc, on a line none
};

enum { LEGEND_MAX = 16 };
struct legend_entry {
    struct mark mark;
    char name[128], tail[128];
};
struct legend {
    int n;
    struct legend_entry entry[LEGEND_MAX];
};

// Adds an entry: a name, whose middle is left out where there is little room, and what is always
// told behind it.
void legend_add(struct legend *l, struct mark mark, const char *name, const char *tail);

// Writes the entries beside each other, in columns where they need more lines than one, and takes
// their room from the top of the canvas's area. Drawn with the first panel.
void legend_write(const struct legend *l, struct canvas *c);

#endif
