// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/reader.h"
#include "model/frame_draft.h"

enum { ROTATION, LINES, N_ROW };

static const struct row rows[N_ROW] = {
    [ROTATION] = {"rotation", ROW_NUMBER, 0, OF_MOMENT, &range_positive, NAN,
                  "stiffness against turning, of each base"},
    [LINES] = {"lines", ROW_LIST, 0, OF_NONE, NULL, NAN,
               "column lines, from 1 at the left; if not given, all of them and the walls"},
};

// The stiffness against turning; -1 after a report.
static double read_base(struct builder *b, const struct statement *s,
                        const struct argument *rotation) {
    enum { FIXED, PINNED, N_KIND };
    static const char *const kinds[N_KIND] = {[FIXED] = "fixed", [PINNED] = "pinned"};
    if (rotation->given == (s->n_plain > 2)) {
        deck_error(b->deck, &s->word[rotation->given ? 2 : 1],
                   "give a base as fixed, as pinned, or by -rotation K");
        return -1.0;
    }
    if (rotation->given) {
        return rotation->number[0];
    }
    const int kind = deck_keyword(b->deck, &s->word[2], "base", kinds, N_KIND);
    return kind < 0 ? -1.0 : kind == FIXED ? (double)INFINITY : 0.0;
}

// Sets a base that is not given yet; false after a report.
static bool set(struct builder *b, const struct statement *s, const struct building_draft *d,
                struct base_draft *base, int line, double rotation) {
    if (base->word.text) {
        char which[32] = "";
        snprintf(which, sizeof which, " of line %d", line);
        return deck_error(b->deck, &s->word[0], "the base%s of building %s is given already, in %s",
                          line ? which : "", d->name,
                          source_mention(b->deck, &base->word.place, &s->word[0].place));
    }
    *base = (struct base_draft){s->word[0], rotation};
    return true;
}

static void build(struct builder *b, const struct statement *s) {
    bool chosen[FRAME_BAYS_MAX + 1];
    struct argument a[N_ROW] = {0};
    if (!builder_plain(b, s, 1, 2, statement_base.usage)) {
        return;
    }
    const int i = builder_building(b, &s->word[1]);
    const double rotation = deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1)
                                ? read_base(b, s, &a[ROTATION])
                                : -1.0;
    if (i < 0 || rotation < 0.0) {
        return;
    }
    struct building_draft *d = builder_draft(b, i);
    if (!a[LINES].given) {
        d->base = d->base ? d->base : arena_alloc(b->arena, 1, sizeof *d->base);
        if (d->base) {
            set(b, s, d, d->base, 0, rotation);
        }
        return;
    }
    if (!frame_draft_has_frame(b, s, d) ||
        !frame_draft_choose(b, &a[LINES], "line", d->frame->n_line, chosen)) {
        return;
    }
    for (int k = 0; k < d->frame->n_line; k++) {
        if (chosen[k] && !set(b, s, d, &d->frame->base[k], k + 1, rotation)) {
            return;
        }
    }
}

const struct statement_kind statement_base = {
    .name = "base",
    .usage = "BUILDING fixed | pinned | -rotation K [-lines LIST]",
    .summary = "bases of columns and walls; fixed if not given; -lines overrides what all have",
    .example = "base A pinned -lines 1 3",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
