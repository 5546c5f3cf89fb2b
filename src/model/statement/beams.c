// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/frame_draft.h"

enum { INERTIA, BAYS, N_ROW };

static const struct row rows[N_ROW] = {
    [INERTIA] =
        {"I", ROW_LIST, ROW_REQUIRED, {0, 4, 0}, &range_positive, NAN, "second moments of area"},
    [BAYS] = {"bays", ROW_LIST, 0, OF_NONE, NULL, NAN,
              "bays, from 1 at the left; all if not given"},
};

static void build(struct builder *b, const struct statement *s) {
    struct frame_members q = {rows, N_ROW, INERTIA, BAYS, .what = "beam"};
    struct argument a[N_ROW] = {0};
    if (builder_plain(b, s, 1, 1, statement_beams.usage) && frame_draft_members(b, s, a, &q)) {
        q.member = q.building->frame->beam;
        frame_draft_place(b, s, &q);
    }
}

const struct statement_kind statement_beams = {
    .name = "beams",
    .usage = "BUILDING:FLOORS -I LIST [-bays LIST]",
    .summary = "beams of a frame on these floors",
    .example = "beams A:1:2 -I 5120in^4",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
