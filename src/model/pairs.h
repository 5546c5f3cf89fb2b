// SPDX-License-Identifier: GPL-3.0-or-later
// What `contact` and `link` share: which floors face each other, and how the links are named.
#ifndef JOSTLE_PAIRS_H
#define JOSTLE_PAIRS_H

#include "model/builder.h"
#include "model/law_choice.h"

struct pairs {
    int building[2];          // left, right; WALL
    int n;                    // pairs of ends
    const int *floor[2];      // (n) left, right; 0 on a wall; of a level, the floor above
    double level[2];          // [L] left, right: between two floors; NAN: at floors or a wall
    bool within;              // both sides are one building
    bool named;               // both sides name their floors by numbers
    const struct word *word;  // (2) LEFT and RIGHT
};

// Reads LEFT and RIGHT, the plain words 1 and 2 of `s`. Reports and returns false where they do not
// pair up. A building joins itself where `walls` is GROUND_ALLOWED only.
bool pairs_read(struct builder *b, const struct statement *s, enum wall_use walls,
                struct pairs *out);

// Appends link k of the pairs to the builder: ends, masses and name (made from `name`, NULL: from
// the ends). NULL after a report.
struct link_draft *pairs_append(struct builder *b, const struct pairs *p, int k, const char *name,
                                const struct word *name_word);

// Reads the text of option -name: a name for links; NULL where not given, *good = false after a
// report.
const char *pairs_name(struct builder *b, const struct argument *a, bool *good);

// Gives a link its law, for the link's effective mass. Reports what is wrong, then false.
bool pairs_set_law(struct builder *b, struct link *link, const struct law_choice *choice);

// Ends of contacts and links that are not one floor: a level between two floors, `BUILDING@LEVEL`,
// and the difference of two ends within one building.

// What `w` names. A parameter that holds a level is replaced in it. END_WRONG: reported.
enum end_kind { END_FLOORS, END_LEVEL, END_WRONG };
enum end_kind level_kind(struct builder *b, struct word *w);

// Reads `w`, a level: the floor above it into `out`, and the level [L] into *level. A level within
// rounding of a floor is that floor: *level is NAN. Reports and returns false if it is wrong.
bool level_read(struct builder *b, const struct word *w, struct selection *out, double *level);

// Gives the link, whose buildings, floors and levels are known, the rows of its ends. False after
// having reported at `w` that both ends are the same.
bool level_rows(struct builder *b, struct link *l, const struct word *w);

// The effective mass of a link between buildings whose masses are known so far.
double level_effective_mass(struct builder *b, const struct link *l);

#endif
