// SPDX-License-Identifier: GPL-3.0-or-later
// The statements `contact` and `link` share: the pairs of ends, and the names of links.
#ifndef JOSTLE_PAIRS_H
#define JOSTLE_PAIRS_H

#include "model/builder.h"
#include "model/law_choice.h"

struct pairs {
    int building[2];          // left, right; WALL
    int n;                    // pairs of ends
    const int *floor[2];      // (n) left, right; 0 on a wall; of a level, the floor above
    const double *level[2];   // [L] (n) left, right: between two floors; NAN: at a floor or a wall
    bool within;              // both sides are one building
    bool named;               // both sides name their floors by numbers, or their levels meet
    bool by_level;            // from pairs_by_level
    const struct word *word;  // (2) LEFT and RIGHT
};

// Reads LEFT and RIGHT, the plain words 1 and 2 of `s`. False after a report, for example if they
// do not pair up. With GROUND_ALLOWED only, both sides may be in the same building.
bool pairs_read(struct builder *b, const struct statement *s, enum wall_use walls,
                struct pairs *out);

// Pairs all floors of the buildings LEFT and RIGHT by their levels: floors whose levels differ by
// less than `depth` [L] face each other. A floor that faces none faces the level of the other
// building at its height, if that is not above the roof. False after a report.
bool pairs_by_level(struct builder *b, const struct statement *s, double depth, struct pairs *out);

// Appends link k of the pairs to the builder, with its ends, effective mass and name. The name is
// made from `name`, or from the ends if it is NULL. NULL after a report.
struct link_draft *pairs_append(struct builder *b, const struct pairs *p, int k, const char *name,
                                const struct word *name_word);

// Reads the option -name, a name for links. NULL if it is not given, or after a report. *good is
// false after a report.
const char *pairs_name(struct builder *b, const struct argument *a, bool *good);

// Sets the law of a link, for the link's effective mass. False after a report.
bool pairs_set_law(struct builder *b, struct link *link, const struct law_choice *choice);

// The law of links of a storey law: its rows are those of links, then its own. NULL: no memory.
struct link_law;
const struct contact_law *pairs_storey_law(struct builder *b, const struct link_law *from);

// Its constants from the values of its rows (NAN: not given); NULL after a report at `w`.
const double *pairs_storey_constants(struct builder *b, const struct link_law *from,
                                     const struct contact_law *law, const double *value,
                                     const struct word *w);

// Ends of contacts and links that are not one floor: a level between two floors, `BUILDING@LEVEL`,
// and the difference of two ends within one building.

// The kind of the end that `w` names. If `w` is a parameter with a level, the level replaces the
// text of `w`. END_WRONG: after a report.
enum end_kind { END_FLOORS, END_LEVEL, END_WRONG };
enum end_kind level_kind(struct builder *b, struct word *w);

// Reads the level `w`. Sets `out` to the floor above the level, and *level to the level [L]. If a
// floor is at this level to rounding, `out` is that floor and *level is NAN. False after a report.
bool level_read(struct builder *b, const struct word *w, struct selection *out, double *level);

// The level of a floor [L], from the heights of the storeys; 0 for the ground, floor 0.
double level_of_floor(const double *height, int floor);

// The weight of the floor above in the displacement of an end at a level: the position in the
// storey as a share of its height; of a column, that of a point without force. NAN: the end is at a
// floor.
double level_weight(struct builder *b, const struct link *l, int side);

// Sets the rows of the ends of a link from its buildings, floors, levels and weights. The end at a
// column has none. False after a report at `w` that both ends are the same.
bool level_rows(struct builder *b, struct link *l, const struct word *w);

// The effective mass of a link, from the masses of its buildings in the builder.
double level_effective_mass(struct builder *b, const struct link *l);

#endif
