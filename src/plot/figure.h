// SPDX-License-Identifier: GPL-3.0-or-later
// A figure is one const descriptor in one file, figure_NAME.c, named by one line in
// figure_list.inc. It writes a stand-alone gnuplot script that holds its data.
#ifndef JOSTLE_FIGURE_H
#define JOSTLE_FIGURE_H

#include <stdio.h>

#include "plot/canvas.h"
#include "plot/runs.h"

// The shape of the picture: across, upright like a page, or across with smaller text.
enum sheet { SHEET_ACROSS, SHEET_PAGE, SHEET_WIDE };

struct figure {
    const char *name;
    const char *doc;  // half a line
    enum sheet sheet;
    // What the runs lack to be drawn, "floor displacements; see output -fields"; NULL: nothing.
    const char *(*lacks)(const struct runs *s);
    // Writes head, legend and panels into the canvas's area, within `set multiplot`. Errors:
    // STATUS_INPUT (a damaged file), STATUS_SYSTEM. Write errors are the caller's.
    int (*draw)(const struct runs *s, struct canvas *c, struct error *e);
};
extern const struct figure *const figures[];
extern const int n_figure;

// The figure called `name`; NULL if there is none.
const struct figure *figure_find(const char *name);

// The first figure of the list that lacks nothing.
const struct figure *figure_default(const struct runs *s);

// Endings of picture files: "png", "svg", "pdf". NULL: `path` ends in none of them.
const char *figure_ending(const char *path);

// Writes what every script begins with: a comment that says what it draws (half a line) and by
// which version, the terminal that makes `output`, a file name with one of the endings, text and
// lines; and what it ends with. The sheet is SHEET_WIDE.
int figure_head(const char *name, const char *doc, const char *version, const char *output,
                FILE *to, struct error *e);
void figure_end(FILE *to);

// Writes the whole script; run by gnuplot it makes `output`, a file name with one of the endings.
// Errors: STATUS_INPUT (what the figure needs is not in the files), and those of draw.
int figure_write(const struct figure *f, const struct runs *s, const char *output, FILE *to,
                 struct error *e);

#endif
