// SPDX-License-Identifier: GPL-3.0-or-later
// Frames and walls in the picture of a deck.
#ifndef JOSTLE_DECK_MEMBERS_H
#define JOSTLE_DECK_MEMBERS_H

#include "plot/deck_links.h"

// Layers of the picture (figure_deck.c).
int deck_members_write_walls(const struct deck_view *v, FILE *to);
int deck_members_write_frames(const struct deck_view *v, FILE *to);
int deck_members_write_fixed(const struct deck_view *v, FILE *to);
int deck_members_write_pinned(const struct deck_view *v, FILE *to);
int deck_members_write_springs(const struct deck_view *v, FILE *to);
int deck_members_write_hinges(const struct deck_view *v, FILE *to);

#endif
