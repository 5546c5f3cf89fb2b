// SPDX-License-Identifier: GPL-3.0-or-later
// P-delta of a building: the gravity loads of its floors and of what leans on it.
#include <math.h>

#include "deck/reader.h"
#include "model/builder.h"

enum { WEIGHT, LEANING, N_ROW };

static const struct row rows[N_ROW] = {
    [WEIGHT] = {"weight", ROW_LIST, 0, OF_FORCE, &range_non_negative, NAN,
                "weights of the floors; their masses times gravity if not given"},
    [LEANING] = {"leaning", ROW_LIST, 0, OF_FORCE, &range_non_negative, NAN,
                 "gravity loads at the floors on columns that resist no lateral force, such as "
                 "those of another frame"},
};

// Adds up what stands at each floor; NULL after a report.
static double *loads_of(struct builder *b, const struct building_draft *d,
                        const struct argument *a) {
    const size_t n = (size_t)d->n_floor;
    const double gravity = builder_gravity(b);
    const char *owner = arena_format(b->arena, "floors of building %s", d->name);
    double *load = arena_alloc(b->arena, n, sizeof *load);
    const double *part[N_ROW] = {NULL};
    bool good = owner && load;
    for (int r = 0; good && r < N_ROW; r++) {
        if (a[r].given) {
            part[r] = builder_spread(b, &a[r], d->n_floor, owner);
            good = part[r] != NULL;
        }
    }
    for (size_t i = 0; good && i < n; i++) {
        load[i] = part[WEIGHT] ? part[WEIGHT][i] : d->mass[i] * gravity;
        load[i] += part[LEANING] ? part[LEANING][i] : 0.0;
    }
    return good ? load : NULL;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 1, 1, statement_pdelta.usage)) {
        return;
    }
    struct argument a[N_ROW] = {0};
    const int i = builder_building(b, &s->word[1]);
    if (!deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) || i < 0) {
        return;
    }
    struct building_draft *d = builder_draft(b, i);
    if (d->pdelta.text) {
        deck_error(b->deck, &s->word[1], "building %s has P-delta already, in %s", d->name,
                   source_mention(b->deck, &d->pdelta.place, &s->word[1].place));
        return;
    }
    d->pdelta = s->word[1];
    if (d->n_floor == 0 || !d->mass) {
        return;
    }
    if (!d->height && !d->any_height) {
        deck_error(b->deck, &s->word[1],
                   "P-delta needs the storey heights of building %s; give building -height",
                   d->name);
        return;
    }
    d->load = loads_of(b, d, a);
    bool any = !d->load;
    for (int k = 0; !any && k < d->n_floor; k++) {
        any = d->load[k] > 0.0;
    }
    if (!any) {
        deck_error(b->deck, &s->word[0],
                   "no floor of building %s has a weight: P-delta does nothing", d->name);
    }
}

const struct statement_kind statement_pdelta = {
    .name = "pdelta",
    .usage = "BUILDING [-weight LIST] [-leaning LIST]",
    .summary = "P-delta of a building: the gravity load above a storey, over its height and times "
               "its drift, pushes it further",
    .example = "pdelta A -leaning 2MN",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
