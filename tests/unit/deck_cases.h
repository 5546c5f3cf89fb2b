// SPDX-License-Identifier: GPL-3.0-or-later
// Reads decks from text for the tests of src/deck/.
#ifndef JOSTLE_DECK_CASES_H
#define JOSTLE_DECK_CASES_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "jostle/deck.h"
#include "support/support.h"

// A text and what is expected of it: all messages as "line:column: message", joined by " | ".
struct deck_case {
    const char *text, *expected;
};

enum { CASE_K, CASE_GAP, CASE_N, CASE_FILE, CASE_FLOORS, CASE_LOG, CASE_ROWS };
static const struct row case_rows[CASE_ROWS] = {
    [CASE_K] =
        {"k", ROW_NUMBER, ROW_PER_LENGTH_POWER, {1, 0, 0}, &range_positive, NAN, "stiffness"},
    [CASE_GAP] = {"gap", ROW_LIST, 0, {0, 1, 0}, &range_non_negative, 0.01, "gaps"},
    [CASE_N] = {"n", ROW_NUMBER, ROW_POWER, {0, 0, 0}, &range_positive, 1.5, "exponent"},
    [CASE_FILE] = {"file", ROW_TEXTS, 0, {0, 0, 0}, NULL, NAN, "files"},
    [CASE_FLOORS] = {"floors", ROW_INTEGER, 0, {0, 0, 0}, NULL, NAN, "number of floors"},
    [CASE_LOG] = {"log", ROW_FLAG, 0, {0, 0, 0}, NULL, NAN, "logarithmic"},
};

static inline struct deck *case_open(const char *text, const char *const *define, int n_define) {
    struct deck *d = NULL;
    struct error e;
    assert_int_equal(deck_open_text("case.deck", text, define, n_define, &d, &e), STATUS_OK);
    return d;
}

// Reads the options of all statements; those of the last stay in `argument` (CASE_ROWS).
static inline void case_read(struct deck *d, struct argument *argument) {
    struct statement s;
    while (deck_next(d, &s)) {
        struct row_set set = {.row = case_rows, .n_row = CASE_ROWS, .argument = argument};
        deck_options(d, &s, &set, 1);
    }
}

static inline void case_messages(const struct deck *d, char *text, size_t size) {
    text[0] = 0;
    for (int i = 0; i < d->diagnostics.n_item; i++) {
        const struct diagnostic *item = &d->diagnostics.item[i];
        size_t used = strlen(text);
        snprintf(text + used, size - used, "%s%d:%d: %s", i ? " | " : "", item->line, item->column,
                 item->message);
    }
}

static inline void case_check(const struct deck_case *c, size_t n) {
    for (size_t i = 0; i < n; i++) {
        struct deck *d = case_open(c[i].text, NULL, 0);
        struct argument argument[CASE_ROWS];
        char messages[4096];
        case_read(d, argument);
        case_messages(d, messages, sizeof messages);
        assert_string_equal(messages, c[i].expected);
        deck_free(d);
    }
}

#endif
