// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "core/arena.h"
#include "core/text.h"
#include "deck/reader.h"
#include "model/builder.h"

enum { FLOORS, MASS, STIFFNESS, HEIGHT, ISOLATED, N_ROW };

static const struct range floors_range = {
    .min = 1.0, .max = FLOORS_MAX, .text = ">= 1 and <= 1000"};

static const struct row rows[N_ROW] = {
    [FLOORS] = {"floors", ROW_INTEGER, ROW_REQUIRED, OF_NONE, &floors_range, NAN,
                "number of floors"},
    [MASS] = {"mass", ROW_LIST, ROW_REQUIRED, OF_MASS, &range_positive, NAN, "floor masses"},
    [STIFFNESS] = {"stiffness", ROW_LIST, 0, OF_STIFFNESS, &range_non_negative, NAN,
                   "stiffnesses of shear storeys, 0 for a free body; required unless a frame, a "
                   "wall or a matrix resists"},
    [HEIGHT] = {"height", ROW_LIST, 0, OF_LENGTH, &range_positive, NAN,
                "storey heights, for drift ratios, frames, walls and P-delta"},
    [ISOLATED] = {"isolated", ROW_INTEGER, 0, OF_NONE, &floors_range, NAN,
                  "storey of the isolators: summaries, drifts of studies and stiffness-"
                  "proportional damping leave it out"},
};

static bool check_name(struct builder *b, const struct word *w, const char *name) {
    struct deck_quote quote;
    if (strcmp(name, "wall") == 0) {
        return deck_error(b->deck, w,
                          "'wall' is the rigid wall of contacts and cannot name a building");
    }
    if (!text_is_name(name)) {
        return deck_error(b->deck, w,
                          "%s cannot name a building; use up to 64 letters, digits, _ and -",
                          deck_quote(&quote, w, name));
    }
    const int i = builder_find_building(b, name, strlen(name));
    if (i >= 0) {
        return deck_error(b->deck, w, "a second building %s; the first is in %s",
                          deck_quote(&quote, w, name),
                          source_mention(b->deck, &builder_draft(b, i)->word.place, &w->place));
    }
    return true;
}

// The number of floors; 0: missing or wrong.
static int count_floors(const struct argument *a) {
    double n = a->n == 1 && a->number ? a->number[0] : 0.0;
    return n >= floors_range.min && n <= floors_range.max && n == floor(n) ? (int)n : 0;
}

static void isolate(struct builder *b, struct building_draft *d, const struct argument *a) {
    if (a->given && a->number[0] > d->n_floor) {
        deck_error(b->deck, a->word, "storey %g is not one of 1 to %d of building %s", a->number[0],
                   d->n_floor, d->name);
    } else if (a->given) {
        d->isolated = (int)a->number[0];
    }
}

// The name and the number of floors are kept even if the rest is wrong. If the name is wrong, the
// deck counts as torn. So later statements do not report an unknown building.
static void build(struct builder *b, const struct statement *s) {
    b->any_building = true;
    if (!builder_plain(b, s, 1, 1, statement_building.usage)) {
        b->deck->torn = true;
        return;
    }
    const char *name = deck_text(b->deck, &s->word[1]);
    bool named = name && check_name(b, &s->word[1], name);
    b->deck->torn = b->deck->torn || !named;
    struct argument a[N_ROW] = {0};
    bool good = deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1);
    if (!named) {
        return;
    }
    struct building_draft *d = builder_add_building(b, name);
    if (!d) {
        return;
    }
    *d = (struct building_draft){
        .name = name,
        .word = s->word[1],
        .n_floor = count_floors(&a[FLOORS]),
        .any_stiffness = a[STIFFNESS].given,
        .any_height = a[HEIGHT].given,
    };
    if (good) {
        size_t n = (size_t)d->n_floor;
        const char *owner = arena_format(b->arena, "floors of building %s", d->name);
        if (owner) {
            d->mass = builder_spread(b, &a[MASS], d->n_floor, owner);
            d->stiffness = a[STIFFNESS].given ? builder_spread(b, &a[STIFFNESS], d->n_floor, owner)
                                              : arena_alloc(b->arena, n, sizeof *d->stiffness);
            if (a[HEIGHT].given) {
                d->height = builder_spread(b, &a[HEIGHT], d->n_floor, owner);
            }
            d->storey = arena_alloc(b->arena, n, sizeof *d->storey);
            d->storey_word = arena_alloc(b->arena, n, sizeof *d->storey_word);
            d->displacement = arena_alloc(b->arena, n, sizeof *d->displacement);
            d->velocity = arena_alloc(b->arena, n, sizeof *d->velocity);
            d->initial = arena_alloc(b->arena, n, sizeof *d->initial);
        }
        isolate(b, d, &a[ISOLATED]);
    }
}

const struct statement_kind statement_building = {
    .name = "building",
    .usage = "NAME -floors N -mass LIST [-stiffness LIST] [-height LIST] [-isolated STOREY]",
    .summary = "a building of shear storeys; the deck lists the buildings from left to right",
    .example = "building A -floors 8 -mass 300t -stiffness 7*345MN/m 250MN/m -height 3.2m",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
