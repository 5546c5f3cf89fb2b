// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts, links and struck columns in the picture of a deck.
#ifndef JOSTLE_DECK_LINKS_H
#define JOSTLE_DECK_LINKS_H

#include "plot/elevation.h"
#include "plot/figure.h"

// The model of a deck, and where its first buildings stand.
struct deck_view {
    const struct model *m;
    struct elevation at;
    bool dense;  // floors so near to each other that lines are thin
};

// A line, the outline of a box, or a point of a data block; `to` NULL: nothing is written.
void deck_put_line(FILE *to, double x0, double y0, double x1, double y1);
void deck_put_box(FILE *to, double x0, double x1, double y0, double y1);
void deck_put_point(FILE *to, double x, double y);

// Layers of the picture (figure_deck.c).
int deck_links_write_contacts(const struct deck_view *v, FILE *to);
int deck_links_write_links(const struct deck_view *v, FILE *to);
int deck_links_write_struck(const struct deck_view *v, FILE *to);
int deck_links_write_rigid(const struct deck_view *v, FILE *to);

// The smallest and the largest gap between neighbours, in a line below the panel; where they
// differ, each gap at its contact, too.
void deck_links_write_gaps(const struct deck_view *v, struct canvas *c, int line);

#endif
