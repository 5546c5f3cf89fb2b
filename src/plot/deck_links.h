// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts, links, struck columns, frames and walls in the picture of a deck.
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

// What is drawn in one style: lines, outlines of boxes, and points.
struct deck_shapes {
    FILE *to;  // the block of data; NULL: they are counted only
    int n;
};
void deck_put_line(struct deck_shapes *s, double x0, double y0, double x1, double y1);
void deck_put_box(struct deck_shapes *s, double x0, double x1, double y0, double y1);
void deck_put_point(struct deck_shapes *s, double x, double y);

// What a layer of the picture draws of building k and in the gap left of it (figure_deck.c).
typedef void deck_layer(const struct deck_view *v, int k, struct deck_shapes *s);
deck_layer deck_links_write_contacts, deck_links_write_links, deck_links_write_struck;
deck_layer deck_links_write_rigid;

// A member of a frame or of a wall, and where it is drawn.
struct deck_member {
    const struct plane_frame *frame;
    const struct frame_member *member;
    bool wall;
    struct elevation_ends at;
};

// What a layer draws of a member; and of all members of building k.
typedef void deck_drawing(const struct deck_member *d, struct deck_shapes *s);
deck_drawing deck_members_wall, deck_members_frame, deck_members_hinges;
deck_drawing deck_members_fixed, deck_members_pinned, deck_members_spring;
void deck_members_write(const struct deck_view *v, int k, struct deck_shapes *s,
                        deck_drawing *draw);

// The smallest and the largest gap between neighbours, in a line below the panel; where they
// differ, each gap at its contact, too.
void deck_links_write_gaps(const struct deck_view *v, struct canvas *c, int line);

#endif
