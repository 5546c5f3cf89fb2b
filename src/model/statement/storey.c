// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>

#include "deck/reader.h"
#include "model/storey_choice.h"

enum { STIFFNESS, DAMAGE, N_ROW = DAMAGE + STOREY_DAMAGE_COUNT };

static const struct row rows[N_ROW] = {
    [STIFFNESS] = {"stiffness", ROW_LIST, 0, OF_STIFFNESS, &range_non_negative, NAN,
                   "initial stiffnesses, instead of those of the building"},
    STOREY_CHOICES_DAMAGE(OF_LENGTH),
};

// Smallest plausible yield drift. Storeys of buildings yield at drifts of millimetres to
// centimetres, isolators at 0.1 mm or more. A very large yield is allowed: the storey stays
// elastic.
static const double YIELD_MIN = 1e-5;  // [m]

// Warns at `w` about a yield in other units than the stiffness; true if it does.
static bool warn_yield(struct builder *b, const struct word *w, const char *building, int floor,
                       double drift) {
    const double metres = drift * b->deck->units.length;
    if (metres < YIELD_MIN) {
        deck_warning(b->deck, w,
                     "storey %d of building %s yields at a drift of %.3g m; are its yield and "
                     "stiffness in the units of the deck?",
                     floor, building, metres);
    }
    return metres < YIELD_MIN;
}

// Warns about the first storey that yields early.
static void warn_yields(struct builder *b, const struct building_draft *d,
                        const struct selection *floors, const struct storey_choices *c) {
    bool warned = false;
    for (int k = 0; c->yield && !warned && k < floors->n_floor; k++) {
        const int i = floors->floor[k] - 1;
        warned = warn_yield(b, &c->given[c->yield_row].word[0], d->name, i + 1,
                            d->storey[i].yield / d->stiffness[i]);
    }
}

static void assign(struct builder *b, const struct statement *s, const struct selection *floors,
                   const struct argument *own, struct storey_choices *c) {
    struct building_draft *d = builder_draft(b, floors->building);
    double *stiffness = NULL;
    bool good = d->stiffness != NULL;
    good &= storey_choices_spread(b, c, floors->n_floor, "storeys");
    if (own[STIFFNESS].given) {
        stiffness = builder_spread(b, &own[STIFFNESS], floors->n_floor, "storeys");
        good &= stiffness != NULL;
    }
    if (good && !stiffness && !d->any_stiffness) {
        deck_error(b->deck, &s->word[1],
                   "the storeys of building %s have no stiffness of their own; give -stiffness",
                   d->name);
        good = false;
    }
    for (int k = 0; good && k < floors->n_floor; k++) {
        int i = floors->floor[k] - 1;
        good = storey_choices_take(b, d, i, s);
        if (good && stiffness) {
            d->stiffness[i] = stiffness[k];
        }
        good = good && storey_choices_prepare(b, &s->word[1], c, k, d->stiffness[i], &d->storey[i]);
    }
    if (good) {
        warn_yields(b, d, floors, c);
    }
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_storey.usage)) {
        return;
    }
    struct selection floors;
    bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &floors);
    struct argument own[N_ROW] = {0};
    struct storey_choices c = {.law = storey_choice_find(b->deck, &s->word[2]),
                               .damage = own + DAMAGE};
    if (!c.law) {
        return;
    }
    struct row_set set[] = {{rows, N_ROW, own}, {c.law->row, c.law->n_row, c.given}};
    if (deck_options(b->deck, s, set, 2) && selected) {
        assign(b, s, &floors, own, &c);
    }
}

const struct statement_kind statement_storey = {
    .name = "storey",
    .usage = "NAME:FLOORS LAW ... [-stiffness LIST] [-damage-ultimate LIST] [-damage-beta LIST]",
    .summary = "restoring law of the storeys below the named floors; other storeys are elastic",
    .example = "storey A:1:3 bilinear -yield 4MN -hardening 0.02",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
