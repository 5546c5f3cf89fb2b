// SPDX-License-Identifier: GPL-3.0-or-later
// A figure is one const descriptor in one file, figure_NAME.c, named by one line in
// figure_list.inc. It writes a gnuplot script, and its data to stand beside it.
#ifndef JOSTLE_FIGURE_H
#define JOSTLE_FIGURE_H

#include <stdio.h>

#include "plot/canvas.h"
#include "plot/runs.h"

// The shape of the picture: across, or upright like a page.
enum sheet { SHEET_ACROSS, SHEET_PAGE };

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

// What a complete picture of that ending has within its last FIGURE_TAIL bytes.
enum { FIGURE_TAIL = 16 };
const char *figure_last_mark(const char *path);

// What a picture is written into. gnuplot finds the data beside the script, under its name with
// .dat in place of .gp.
struct figure_files {
    FILE *script, *data;  // borrowed
    const char *picture;  // that the script makes: a file name with one of the endings
};

// What opens both files: what is drawn (half a line), and by which version of the program.
struct figure_head {
    const char *name, *doc, *version;
    const struct unit_system *units;  // borrowed by the canvas
    enum sheet sheet;
};

// Writes what every script begins with, the terminal, text and lines, and sets `c` to the empty
// sheet; and what every script ends with. Errors: STATUS_INPUT (the picture has another ending).
int figure_open(const struct figure_head *head, const struct figure_files *to, struct canvas *c,
                struct error *e);
void figure_close(const struct canvas *c);

// Writes the whole script and its data. Errors: STATUS_INPUT (what the figure needs is not in the
// files), and those of draw. Write errors are the caller's.
int figure_write(const struct figure *f, const struct runs *s, const struct figure_files *to,
                 struct error *e);

#endif
