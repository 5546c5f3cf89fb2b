// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "model/statement.h"

static const struct row dt_row = {"step",          ROW_NUMBER, ROW_REQUIRED, {0, 0, 1},
                                  &range_positive, NAN,        "time step"};

static void build(struct builder *b, const struct statement *s) {
    static const char *const known[] = {"fixed"};
    if (!builder_once(b, &b->step, s) || !builder_plain(b, s, 1, 2, statement_step.usage)) {
        return;
    }
    const char *kind = s->word[1].text;
    if ((kind[0] >= '0' && kind[0] <= '9') || kind[0] == '$') {
        deck_error(b->deck, &s->word[1], "step needs its kind; write: step fixed %s", kind);
        return;
    }
    if (strcmp(kind, "adaptive") == 0) {
        deck_error(b->deck, &s->word[1],
                   "adaptive steps are not available in this version; use step fixed DT");
        return;
    }
    if (strcmp(kind, known[0]) != 0) {
        deck_unknown(b->deck, &s->word[1], "kind of step", known, 1);
        return;
    }
    struct argument dt = {0};
    if (builder_plain(b, s, 2, 2, statement_step.usage) && deck_options(b->deck, s, NULL, 0) &&
        deck_values(b->deck, &dt_row, 0.0, &s->word[2], 1, &dt)) {
        b->dt = dt.number[0];
    }
}

const struct statement_kind statement_step = {
    .name = "step",
    .usage = "fixed DT",
    .summary = "time step; the last one is shorter where the duration is not a multiple",
    .example = "step fixed 0.5ms",
    .build = build,
};
