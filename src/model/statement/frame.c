// SPDX-License-Identifier: GPL-3.0-or-later
#include "deck/reader.h"
#include "model/frame_draft.h"

enum { BAYS, MODULUS, INEXTENSIBLE, N_ROW };

static const struct row rows[N_ROW] = {
    [BAYS] = {"bays", ROW_LIST, ROW_REQUIRED, OF_LENGTH, &range_positive, NAN,
              "widths of the bays from left to right; column lines 1, 2, ... are beside them"},
    [MODULUS] = {"modulus", ROW_NUMBER, ROW_REQUIRED, OF_STRESS, &range_positive, NAN,
                 "Young's modulus of columns and beams"},
    [INEXTENSIBLE] = {"columns-inextensible", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                      "the columns keep their lengths and have no -A"},
};

// True if the building can have this frame; false after a report.
static bool may_have(struct builder *b, const struct statement *s, const struct building_draft *d,
                     const struct argument *bays) {
    if (d->frame) {
        return deck_error(b->deck, &s->word[0], "building %s has a frame already, in %s", d->name,
                          source_mention(b->deck, &d->frame->word.place, &s->word[0].place));
    }
    if (bays->n > FRAME_BAYS_MAX) {
        return deck_error(b->deck, &bays->key, "a frame of %d bays; it has at most %d", bays->n,
                          FRAME_BAYS_MAX);
    }
    return builder_has_heights(b, d, &s->word[1], "a frame");
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 1, 1, statement_frame.usage)) {
        return;
    }
    struct argument a[N_ROW] = {0};
    const int i = builder_building(b, &s->word[1]);
    const bool good = deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1);
    if (i < 0) {
        return;
    }
    struct building_draft *d = builder_draft(b, i);
    d->any_part = d->any_frame = true;
    if (!good || !may_have(b, s, d, &a[BAYS])) {
        return;
    }
    const size_t n = (size_t)d->n_floor, n_line = (size_t)a[BAYS].n + 1;
    struct frame_draft *f = arena_alloc(b->arena, 1, sizeof *f);
    if (!f) {
        return;
    }
    *f = (struct frame_draft){
        .word = s->word[0],
        .n_line = (int)n_line,
        .bay = a[BAYS].number,
        .modulus = a[MODULUS].number[0],
        .inextensible = a[INEXTENSIBLE].given,
        .column = arena_alloc(b->arena, n * n_line, sizeof *f->column),
        .beam = arena_alloc(b->arena, n * (n_line - 1), sizeof *f->beam),
        .base = arena_alloc(b->arena, n_line, sizeof *f->base),
        .column_hinge = arena_alloc(b->arena, 2 * n * n_line, sizeof *f->column_hinge),
        .beam_hinge = arena_alloc(b->arena, 2 * n * (n_line - 1), sizeof *f->beam_hinge),
    };
    d->frame = f;
}

const struct statement_kind statement_frame = {
    .name = "frame",
    .usage = "BUILDING -bays LIST -modulus E [-columns-inextensible]",
    .summary = "a plane frame of the building, whose columns and beams follow; floors are axially "
               "rigid",
    .example = "frame A -bays 2*360in -modulus 29500ksi",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
