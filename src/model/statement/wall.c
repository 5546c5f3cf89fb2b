// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/frame_draft.h"

enum { EI, GA, N_ROW };

static const struct row rows[N_ROW] = {
    [EI] = {"EI", ROW_LIST, ROW_REQUIRED, OF_BENDING, &range_positive, NAN,
            "bending stiffnesses of its storeys"},
    [GA] = {"GA", ROW_LIST, 0, OF_FORCE, &range_positive, NAN,
            "shear stiffnesses, on the effective area; without them it only bends"},
};

// True if the storeys are those from the ground up to the last one; false after a report.
static bool stands_on_ground(struct builder *b, const struct statement *s,
                             const struct selection *selection) {
    for (int i = 0; i < selection->n_floor; i++) {
        if (selection->floor[i] != i + 1) {
            return deck_error(b->deck, &s->word[1],
                              "a wall stands on the ground: its storeys are 1 to N, in this order");
        }
    }
    return true;
}

static void build(struct builder *b, const struct statement *s) {
    struct argument a[N_ROW] = {0};
    struct selection selection;
    if (!builder_plain(b, s, 1, 1, statement_wall.usage)) {
        return;
    }
    const bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &selection);
    const bool good = deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1);
    if (selection.building < 0) {
        return;
    }
    struct building_draft *d = builder_draft(b, selection.building);
    d->any_part = d->any_wall = true;
    if (!selected || !good || !stands_on_ground(b, s, &selection) ||
        !builder_has_heights(b, d, &s->word[1], "a wall")) {
        return;
    }
    struct wall_draft wall = {.word = s->word[0], .n_floor = selection.n_floor};
    wall.ei = builder_spread(b, &a[EI], wall.n_floor, "selected storeys");
    wall.ga = a[GA].given ? builder_spread(b, &a[GA], wall.n_floor, "selected storeys") : NULL;
    struct wall_draft *room =
        wall.ei && (wall.ga || !a[GA].given) ? builder_append(b, &d->walls, sizeof *room) : NULL;
    if (room) {
        *room = wall;
    }
}

const struct statement_kind statement_wall = {
    .name = "wall",
    .usage = "BUILDING[:FLOORS] -EI LIST [-GA LIST]",
    .summary = "a cantilever in bending and shear; adds to what else resists in the building",
    .example = "wall A:1:8 -EI 4*93.75GN*m^2 4*75GN*m^2 -GA 4*15.6GN 4*12.5GN",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
