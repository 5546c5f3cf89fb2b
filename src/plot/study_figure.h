// SPDX-License-Identifier: GPL-3.0-or-later
// A figure of a study is one const descriptor in one file, study_NAME.c, named by one line in
// study_figure_list.inc.
#ifndef JOSTLE_STUDY_FIGURE_H
#define JOSTLE_STUDY_FIGURE_H

#include "plot/figure.h"
#include "plot/panel.h"
#include "study/suite.h"

// What is drawn.
struct study_picture {
    const struct suite *suite;
    const double *limit;  // (n_limit) of the demand
    int n_limit;
};

struct study_figure {
    const char *name;
    const char *doc;         // half a line
    enum suite_guess guess;  // of the sweep it goes along
    // Why it cannot be drawn. Errors: STATUS_INPUT.
    int (*check)(const struct study_picture *p, struct error *e);
    // As of struct figure.
    int (*draw)(const struct study_picture *p, struct canvas *c, struct error *e);
};
extern const struct study_figure *const study_figures[];
extern const int n_study_figure;

// The figure called `name`; NULL if there is none.
const struct study_figure *study_figure_find(const char *name);

// The figure that shows best what the suite holds.
const struct study_figure *study_figure_default(const struct suite *s);

// Writes the whole script and its data. Errors: STATUS_INPUT, and those of draw. Write errors are
// the caller's.
int study_figure_write(const struct study_figure *f, const struct study_picture *p,
                       const struct figure_files *to, struct error *e);

// --- what they have in common --------------------------------------------------------------------

// The demand as it is drawn: ratios in percent.
struct study_demand {
    double factor;     // from its values
    const char *unit;  // of an axis, NULL: that of the dimension
    char name[96];     // "drift ratio, A"
};
void study_demand_init(struct study_demand *d, const struct suite *s);
struct axis study_demand_axis(const struct study_demand *d, const struct suite *s,
                              struct span span);

// The axis of the sweep, logarithmic where its values are in equal ratios over a decade or more.
struct axis study_abscissa_axis(const struct suite *s);

// Title, and a subtitle: the runs that failed, `what` is shown, and at which values of --at.
void study_head(struct canvas *c, const struct suite *s, const char *what);

// Rings around accelerations of floors that were hit, $hit of the data: in the legend, and as the
// last series of a panel.
void study_hit_legend(const struct suite *s, struct legend *l);
void study_hit_series(const struct suite *s, struct canvas *c);

// The name of a group as it is shown, into `text`.
void study_group_text(const struct suite *s, int group, char *text, size_t size);

// A limit with its unit, "2 %".
void study_limit_text(const struct study_demand *d, const struct suite *s, double limit, char *text,
                      size_t size);

// Opens the panel: the room at the left is for numbers of five characters.
void study_panel(struct canvas *c, double bottom, const struct axis *x, const struct axis *y);
// Writes what stands across below the panel, at the foot of the sheet.
void study_foot(const struct canvas *c, const char *text);
double study_panel_width(const struct canvas *c);  // [em]

// A number of the data; what is not finite becomes NaN, which gnuplot leaves out.
void study_number(FILE *to, double value);

#endif
