// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/frame_draft.h"

enum { INERTIA, AREA, LINES, N_ROW };

static const struct row rows[N_ROW] = {
    [INERTIA] =
        {"I", ROW_LIST, ROW_REQUIRED, {0, 4, 0}, &range_positive, NAN, "second moments of area"},
    [AREA] = {"A", ROW_LIST, 0, OF_AREA, &range_positive, NAN,
              "areas of the sections, for axial deformation"},
    [LINES] = {"lines", ROW_LIST, 0, OF_NONE, NULL, NAN,
               "column lines, from 1 at the left; all if not given"},
};

// Reports -A of a frame whose columns do not stretch, and warns of columns without -A.
static bool check_area(struct builder *b, const struct statement *s, const struct building_draft *d,
                       const struct argument *area) {
    if (area->given && d->frame->inextensible) {
        d->frame->torn = true;
        return deck_error(b->deck, &area->key,
                          "option -A has no effect, as frame %s has -columns-inextensible",
                          d->name);
    }
    if (!area->given && !d->frame->inextensible) {
        deck_warning(b->deck, &s->word[0],
                     "columns without -A keep their lengths; frame %s -columns-inextensible says "
                     "so",
                     d->name);
    }
    return true;
}

static void build(struct builder *b, const struct statement *s) {
    struct frame_members q = {rows, N_ROW, INERTIA, LINES, .what = "column"};
    struct argument a[N_ROW] = {0};
    if (!builder_plain(b, s, 1, 1, statement_columns.usage) || !frame_draft_members(b, s, a, &q) ||
        !check_area(b, s, q.building, &a[AREA])) {
        return;
    }
    if (a[AREA].given) {
        q.area = builder_spread(b, &a[AREA], q.selection.n_floor, "selected storeys");
        q.building->frame->torn |= !q.area;
    }
    q.member = q.building->frame->column;
    frame_draft_place(b, s, &q);
}

const struct statement_kind statement_columns = {
    .name = "columns",
    .usage = "BUILDING:FLOORS -I LIST [-A LIST] [-lines LIST]",
    .summary = "columns of a frame, of the storeys below these floors",
    .example = "columns A:1:3 -I 3230in^4 -A 72.3in^2 -lines 1 3",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
