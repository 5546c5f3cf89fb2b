// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures of studies have in common.
#ifndef JOSTLE_STUDY_FIGURE_H
#define JOSTLE_STUDY_FIGURE_H

#include "plot/figure.h"
#include "plot/panel.h"

// The demand as it is drawn: ratios in percent.
struct study_demand {
    double factor;     // from its values
    const char *unit;  // of an axis, NULL: that of the dimension
    char name[96];     // "drift ratio, A"
};
void study_demand_init(struct study_demand *d, const struct edp *edp);
struct axis study_demand_axis(const struct study_demand *d, const struct suite *s,
                              struct span span);

// The axis of the sweep, logarithmic where its values are in equal ratios over a decade or more.
struct axis study_abscissa_axis(const struct suite *s);

// Title, and a subtitle: the runs that failed, `what` is shown, and at which values of --at.
void study_head(struct canvas *c, const struct suite *s, const char *what, ...)
    __attribute__((format(printf, 3, 4)));

// Rings around accelerations of floors that were hit, $hit of the data: in the legend, and as the
// last series of a panel.
void study_hit_legend(const struct suite *s, struct legend *l);
void study_hit_series(const struct suite *s, struct canvas *c);

// The name of a group as it is shown, into `text`.
void study_group_text(const struct suite *s, int group, char *text, size_t size);

// The entry of --limit in the legend, if limits are given.
void study_limit_legend(const struct subject *p, struct legend *l);

// A limit with its unit, "2 %".
void study_limit_text(const struct study_demand *d, const struct suite *s, double limit, char *text,
                      size_t size);

// Opens a panel in the area, with the name of its upright axis clear of numbers of five characters.
void study_panel_in(struct canvas *c, struct area a, const struct axis *x, const struct axis *y);

// Opens the only panel of a figure.
void study_panel(struct canvas *c, double bottom, const struct axis *x, const struct axis *y);
// Writes what stands across below the panel, at the foot of the sheet.
void study_foot(const struct canvas *c, const char *text);
double study_panel_width(const struct canvas *c);  // [em]

// A number of the data, and a line of two. Numbers that are not finite become NaN, which gnuplot
// leaves out.
void study_number(FILE *to, double value);
void study_point(FILE *to, double x, double y);

#endif
