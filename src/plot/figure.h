// SPDX-License-Identifier: GPL-3.0-or-later
// A figure is one const descriptor in one file, figure_NAME.c, named by one line in
// figure_list.inc. It writes a stand-alone gnuplot script that holds its data.
#ifndef JOSTLE_FIGURE_H
#define JOSTLE_FIGURE_H

#include <stdio.h>

#include "jostle/result.h"

struct figure {
    const char *name;
    const char *doc;  // half a line
    // Writes the plot commands behind the common head. Errors: STATUS_INPUT (the file lacks a
    // history), STATUS_SYSTEM. Write errors of `to` are the caller's.
    int (*draw)(const struct result_file *file, FILE *to, struct error *e);
};
extern const struct figure *const figures[];
extern const int n_figure;

// The figure called `name`; NULL if there is none.
const struct figure *figure_find(const char *name);

// Endings of picture files: "png", "svg", "pdf". NULL: `path` ends in none of them.
const char *figure_ending(const char *path);

// Writes what every script begins with: a comment that says what it draws (half a line) and by
// which version, the terminal that makes `output`, a file name with one of the endings, text and
// lines; and what it ends with.
int figure_head(const char *name, const char *doc, const char *version, const char *output,
                FILE *to, struct error *e);
void figure_end(FILE *to);

// Writes the whole script; run by gnuplot it makes `output`, a file name with one of the endings.
int figure_write(const struct figure *f, const struct result_file *file, const char *output,
                 FILE *to, struct error *e);

#endif
