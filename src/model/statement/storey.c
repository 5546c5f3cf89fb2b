// SPDX-License-Identifier: GPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "deck/reader.h"
#include "model/builder.h"
#include "model/storey_draft.h"

enum { STIFFNESS, N_ROW };

static const struct row rows[N_ROW] = {
    [STIFFNESS] = {"stiffness", ROW_LIST, 0, OF_STIFFNESS, &range_non_negative, NAN,
                   "initial stiffnesses, instead of those of the building"},
};

// The values of the law's rows of the k-th selected storey.
static void values_of(const struct storey_law *law, double *const *value,
                      const struct argument *given, int k, double own[STOREY_ROWS_MAX]) {
    for (int r = 0; r < law->n_row; r++) {
        const bool flag = law->row[r].kind == ROW_FLAG && given[r].given;
        own[r] = value[r] ? value[r][k] : flag ? 1.0 : NAN;
    }
}

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

static void assign(struct builder *b, const struct statement *s, const struct storey_law *law,
                   const struct selection *floors, const struct argument *own,
                   const struct argument *given) {
    struct building_draft *d = builder_draft(b, floors->building);
    double *value[STOREY_ROWS_MAX] = {0};
    double *stiffness = NULL;
    bool good = d->stiffness != NULL;
    for (int r = 0; r < law->n_row; r++) {
        if (given[r].n > 0) {
            value[r] = builder_spread(b, &given[r], floors->n_floor, "storeys");
            good &= value[r] != NULL;
        }
    }
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
        double own_value[STOREY_ROWS_MAX];
        good = storey_draft_take(b, d, i, s);
        if (good && stiffness) {
            d->stiffness[i] = stiffness[k];
        }
        values_of(law, value, given, k, own_value);
        good = good && storey_draft_set(b, d, i, &s->word[1], law, own_value);
    }
    if (good) {
        // Sets the yield shears of the storeys, for laws with a row `yield`. At most one warning
        // for a statement.
        int row = 0;
        while (row < law->n_row && !(value[row] && strcmp(law->row[row].key, "yield") == 0)) {
            row++;
        }
        bool warned = false;
        for (int k = 0; k < floors->n_floor; k++) {
            const int i = floors->floor[k] - 1;
            const double yield = row < law->n_row ? value[row][k] : INFINITY;
            d->storey[i].yield = yield;
            warned = warned || (isfinite(yield) && warn_yield(b, &given[row].word[0], d->name,
                                                              i + 1, yield / d->stiffness[i]));
        }
    }
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_storey.usage)) {
        return;
    }
    struct selection floors;
    bool selected = builder_select(b, &s->word[1], WALL_REFUSED, &floors);
    const char *name = deck_text(b->deck, &s->word[2]);
    const struct storey_law *law = name ? storey_law_find(name) : NULL;
    if (name && !law) {
        const char **known = arena_alloc(b->arena, (size_t)n_storey_law, sizeof *known);
        for (int i = 0; known && i < n_storey_law; i++) {
            known[i] = storey_laws[i]->name;
        }
        if (known) {
            deck_unknown(b->deck, &s->word[2], name, "storey law", known, n_storey_law);
        }
    }
    if (!law) {
        return;
    }
    struct argument own[N_ROW] = {0};
    struct argument given[STOREY_ROWS_MAX] = {0};
    struct row_set set[] = {{rows, N_ROW, own}, {law->row, law->n_row, given}};
    if (deck_options(b->deck, s, set, 2) && selected) {
        assign(b, s, law, &floors, own, given);
    }
}

const struct statement_kind statement_storey = {
    .name = "storey",
    .usage = "NAME:FLOORS LAW ... [-stiffness LIST]",
    .summary = "restoring law of the storeys below the named floors; other storeys are elastic",
    .example = "storey A:1:3 bilinear -yield 4MN -hardening 0.02",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
