// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of drift at which a run ends and counts as a collapse.
#include "deck/reader.h"
#include "model/builder.h"

enum { STOREYS, N_ROW };

static const struct row rows[N_ROW] = {
    [STOREYS] =
        {"storeys", ROW_TEXTS, 0, OF_NONE, NULL, NAN,
         "buildings, or storeys of buildings, that have the limit: A:1:4 B; all if not given"},
};

// What the limit is of. A ratio far above 1 means a length, or a per cent without its sign.
static const struct range ratio_range = {
    .min = 0.0, .max = 1.0, .min_open = true, .text = "> 0 and <= 1 (10 % is 0.1)"};
enum { DRIFT, DRIFT_RATIO, N_KIND };
static const char *const kinds[N_KIND] = {[DRIFT] = "drift", [DRIFT_RATIO] = "drift-ratio"};
static const struct row limit_rows[N_KIND] = {
    [DRIFT] = {"drift", ROW_NUMBER, ROW_REQUIRED, OF_LENGTH, &range_positive, NAN, "limit"},
    [DRIFT_RATIO] = {"drift-ratio", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &ratio_range, NAN, "limit"},
};

// Reads the storeys; false after a report.
static bool select_storeys(struct builder *b, const struct argument *a,
                           struct collapse_draft *out) {
    struct selection *storeys = arena_alloc(b->arena, (size_t)a->n, sizeof *storeys);
    bool good = storeys != NULL;
    for (int i = 0; storeys && i < a->n; i++) {
        good = builder_select(b, &a->word[i], WALL_REFUSED, &storeys[i]) && good;
    }
    out->storeys = storeys;
    out->n_selection = a->n;
    return good;
}

static void build(struct builder *b, const struct statement *s) {
    if (!builder_plain(b, s, 2, 2, statement_collapse.usage)) {
        return;
    }
    struct argument a[N_ROW] = {0}, limit = {0};
    const bool good = deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1);
    const int kind = deck_keyword(b->deck, &s->word[1], "limit", kinds, N_KIND);
    struct collapse_draft new = {.is_ratio = kind == DRIFT_RATIO, .word = s->word[1]};
    if (!good || kind < 0 ||
        !deck_values(b->deck, &limit_rows[kind], 0.0, &s->word[2], 1, &limit) ||
        (a[STOREYS].given && !select_storeys(b, &a[STOREYS], &new))) {
        return;
    }
    struct collapse_draft *room = builder_append(b, &b->collapses, sizeof *room);
    if (room) {
        *room = new;
        room->limit = limit.number[0];
    }
}

const struct statement_kind statement_collapse = {
    .name = "collapse",
    .usage = "drift-ratio RATIO | drift D [-storeys STOREYS]",
    .summary =
        "the run ends, and counts as a collapse, when the drift of a storey reaches this share "
        "of its height, or this length",
    .example = "collapse drift-ratio 10% -storeys A:1:4",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
