// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/builder.h"

static const struct row time_row = {"duration",      ROW_NUMBER, ROW_REQUIRED, OF_TIME,
                                    &range_positive, NAN,        "duration"};

static void build(struct builder *b, const struct statement *s) {
    struct argument time = {0};
    if (builder_once(b, &b->duration, s) && builder_plain(b, s, 1, 1, statement_duration.usage) &&
        deck_options(b->deck, s, NULL, 0) &&
        deck_values(b->deck, &time_row, 0.0, &s->word[1], 1, &time)) {
        b->run_time = time.number[0];
    }
}

const struct statement_kind statement_duration = {
    .name = "duration",
    .usage = "T",
    .summary = "length of the analysis; default: to the end of the longest record",
    .example = "duration 40s",
    .build = build,
};
