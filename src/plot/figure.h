// SPDX-License-Identifier: GPL-3.0-or-later
// A figure of runs or of a study is one const descriptor in one file, figure_NAME.c, named by one
// line in figure_list.inc. It writes a gnuplot script, and its data to stand beside it.
#ifndef JOSTLE_FIGURE_H
#define JOSTLE_FIGURE_H

#include <stdio.h>

#include "plot/canvas.h"
#include "plot/runs.h"
#include "study/suite.h"

// The shape of the picture: across, or upright like a page.
enum sheet { SHEET_ACROSS, SHEET_PAGE };

// What a figure shows: one or two runs, the suite of a study, or the model of a deck.
enum subject_kind { SUBJECT_RUNS, SUBJECT_STUDY, SUBJECT_DECK };
struct subject {
    const struct runs *runs;    // NULL: no runs
    const struct suite *suite;  // NULL: no study
    const double *limit;        // (n_limit) of the demand of the suite
    int n_limit;
    const struct model *model;  // NULL: no deck
    const char *version;        // of the program, with a model
};

struct figure {
    const char *name;
    const char *doc;  // half a line
    enum sheet sheet;
    enum subject_kind of;
    enum suite_guess guess;  // of a suite: the sweep that the figure goes along
    // Why the figure cannot be drawn, as the end of "NAME cannot be drawn: "; NULL: it always can.
    // Errors: STATUS_INPUT.
    int (*check)(const struct subject *p, struct error *e);
    // Writes head, legend and panels into the canvas's area, within `set multiplot`. The canvas has
    // the failures: STATUS_INPUT (a damaged file), STATUS_SYSTEM. Write errors are the caller's.
    void (*draw)(const struct subject *p, struct canvas *c);
};
extern const struct figure *const figures[];
extern const int n_figure;

// The figure called `name`; NULL if there is none.
const struct figure *figure_find(const char *name);

// True if the figure shows such a subject and nothing that it needs is missing.
bool figure_can_draw(const struct figure *f, const struct subject *p);

// Runs: the first figure of the list that can be drawn. A suite: ida, where records are scaled, or
// response. A model: deck.
const struct figure *figure_default(const struct subject *p);

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
// sheet; and what every script ends with. The first failure is that of figure_close; of
// figure_open it is STATUS_INPUT (the picture has another ending).
void figure_open(const struct figure_head *head, const struct figure_files *to, struct canvas *c,
                 struct error *e);
int figure_close(const struct canvas *c);

// Writes the whole script and its data. Errors: STATUS_INPUT (the figure cannot be drawn), and
// those of draw. Write errors are the caller's.
int figure_write(const struct figure *f, const struct subject *p, const struct figure_files *to,
                 struct error *e);

#endif
