// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/builder.h"

enum { DISPLACEMENT, VELOCITY, N_ROW };

static const struct row rows[N_ROW] = {
    [DISPLACEMENT] = {"displacement", ROW_NUMBER, 0, OF_LENGTH, NULL, 0.0,
                      "relative to the ground, at t = 0"},
    [VELOCITY] = {"velocity", ROW_NUMBER, 0, OF_VELOCITY, NULL, 0.0,
                  "relative to the ground, at t = 0"},
};

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 1, 1, statement_initial.usage)) {
        return;
    }
    struct selection floors;
    bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &floors);
    struct argument a[N_ROW] = {0};
    if (!deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) || !selected) {
        return;
    }
    if (!a[DISPLACEMENT].given && !a[VELOCITY].given) {
        deck_error(b->deck, &s->word[0], "initial needs -displacement or -velocity");
        return;
    }
    struct building_draft *d = builder_draft(b, floors.building);
    for (int k = 0; d->initial && k < floors.n_floor; k++) {
        int i = floors.floor[k] - 1;
        if (d->initial[i].text) {
            deck_error(b->deck, &s->word[1], "floor %d of building %s has an initial state already",
                       i + 1, d->name);
            return;
        }
        d->initial[i] = s->word[1];
        d->displacement[i] = a[DISPLACEMENT].number[0];
        d->velocity[i] = a[VELOCITY].number[0];
    }
}

const struct statement_kind statement_initial = {
    .name = "initial",
    .usage = "BUILDING:FLOORS [-displacement U] [-velocity V]",
    .summary = "initial displacement and velocity of floors; other floors start at rest",
    .example = "initial A:1 -velocity 0.5m/s",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
