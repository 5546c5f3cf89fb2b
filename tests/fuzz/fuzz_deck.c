// SPDX-License-Identifier: GPL-3.0-or-later
// Feeds any bytes to the deck reader and reads every word of every statement in every way.
// Build with clang -fsanitize=fuzzer,address,undefined.
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "jostle/deck.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { N_ROW = 5 };
static const struct row rows[N_ROW] = {
    {.key = "k",
     .kind = ROW_NUMBER,
     .flags = ROW_PER_LENGTH_POWER,
     .dimension = {1, 0, 0},
     .range = &range_positive,
     .fallback = NAN,
     .doc = "a stiffness"},
    {.key = "gap", .kind = ROW_LIST, .dimension = {0, 1, 0}, .fallback = 0.01, .doc = "gaps"},
    {.key = "n", .kind = ROW_NUMBER, .flags = ROW_POWER, .fallback = 1.5, .doc = "the exponent"},
    {.key = "file", .kind = ROW_TEXTS, .doc = "files"},
    {.key = "log", .kind = ROW_FLAG, .doc = "a flag"},
};

static void read_all(struct deck *d, const struct statement *s) {
    struct argument argument[N_ROW];
    struct row_set set = {.row = rows, .n_row = N_ROW, .argument = argument};
    deck_options(d, s, &set, 1);
    for (int i = 0; i < s->n_word; i++) {
        struct argument value;
        if (deck_values(d, &rows[1], 0, &s->word[i], 1, &value) && !isfinite(value.number[0])) {
            abort();
        }
        deck_values(d, &rows[0], 1.5, &s->word[i], 1, &value);
        const char *text = deck_text(d, &s->word[i]);
        if (text) {
            deck_file(d, &s->word[i], text);
        }
    }
}

// The input up to a 0 byte is a -D, the rest is the deck; without a 0 byte all is the deck.
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *bytes = malloc(size + 1);
    if (!bytes) {
        return 0;
    }
    memcpy(bytes, data, size);
    bytes[size] = 0;
    size_t first = strlen(bytes);
    const char *const define[] = {bytes};
    const char *text = first < size ? bytes + first + 1 : bytes;
    struct deck *d;
    struct error e;
    if (deck_open_text("fuzz/a.deck", text, define, first < size ? 1 : 0, &d, &e) == STATUS_OK) {
        struct statement s;
        do {
            while (deck_next(d, &s)) {
                read_all(d, &s);
            }
        } while (deck_rewind(d));
        deck_parameters(d);
        FILE *null = fopen("/dev/null", "w");
        if (null) {
            diagnostics_print(&d->diagnostics, null, true);
            fclose(null);
        }
        deck_free(d);
    }
    free(bytes);
    return 0;
}
