// SPDX-License-Identifier: GPL-3.0-or-later
// The legend of a picture, in lines below its head.
#ifndef JOSTLE_LEGEND_H
#define JOSTLE_LEGEND_H

#include "plot/panel.h"

enum { LEGEND_MAX = 16 };
struct legend_entry {
    struct style mark;
    char name[128], tail[128];
};
struct legend {
    int n;
    struct legend_entry entry[LEGEND_MAX];
};

// Adds an entry: a sample of the style, a line, points or an area, a name, whose middle is left out
// where there is little room, and what is always told behind it.
void legend_add(struct legend *l, struct style mark, const char *name, const char *tail);

// Writes the entries beside each other, in columns where they need more lines than one, and takes
// their room from the top of the canvas's area. Drawn with the first panel.
void legend_write(const struct legend *l, struct canvas *c);

#endif
