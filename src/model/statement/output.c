// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "model/builder.h"

enum { EVERY, INTERVAL, FIELDS, PRECISION, COMPRESS, FILE_NAME, HISTORIES, N_ROW };

static const struct range every_range = {
    .min = 1.0, .max = OUTPUT_EVERY_MAX, .text = ">= 1 and <= 1e9"};
static const struct range level_range = {.min = 1.0, .max = 9.0, .text = ">= 1 and <= 9"};

static const struct row rows[N_ROW] = {
    [EVERY] = {"every", ROW_INTEGER, 0, OF_NONE, &every_range, NAN, "steps between two rows"},
    [INTERVAL] = {"interval", ROW_NUMBER, 0, OF_TIME, &range_positive, NAN,
                  "time between rows, a multiple of a fixed step; default: 0.01 s, and with step "
                  "adaptive at "
                  "most duration / 100"},
    [FIELDS] = {"fields", ROW_TEXTS, 0, OF_NONE, NULL, NAN, "histories to write; default: all"},
    [PRECISION] = {"precision", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                   "single writes histories in 32 bits"},
    [COMPRESS] = {"compress", ROW_INTEGER, 0, OF_NONE, &level_range, NAN,
                  "level of the compression of histories by shuffle and deflate"},
    [HISTORIES] = {"histories", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                   "writes the histories of each run of a study"},
    [FILE_NAME] = {"file", ROW_TEXT, 0, OF_NONE, NULL, NAN,
                   "result file, relative to the current directory"},
};

const char *const field_names[] = {"displacement", "velocity",     "acceleration",
                                   "drift",        "storey_shear", "force",
                                   "penetration",  "members",      NULL};
enum { N_FIELD = sizeof field_names / sizeof field_names[0] - 1 };

static void read_fields(struct builder *b, const struct argument *a) {
    struct deck_quote quote;
    b->out.fields = 0;
    for (int i = 0; i < a->n; i++) {
        unsigned bit = 0;
        for (int k = 0; k < N_FIELD; k++) {
            bit |= strcmp(field_names[k], a->text[i]) == 0 ? 1U << k : 0U;
        }
        if (!bit) {
            deck_unknown(b->deck, &a->word[i], a->text[i], "field", field_names, N_FIELD);
        } else if (b->out.fields & bit) {
            deck_error(b->deck, &a->word[i], "field %s is named twice",
                       deck_quote(&quote, &a->word[i], a->text[i]));
        }
        b->out.fields |= bit;
    }
}

static void read_precision(struct builder *b, const struct argument *a) {
    static const char *const known[] = {"single", "double"};
    b->out.single = strcmp(a->text[0], known[0]) == 0;
    if (!b->out.single && strcmp(a->text[0], known[1]) != 0) {
        deck_unknown(b->deck, &a->word[0], a->text[0], "precision", known, 2);
    }
}

static void build(struct builder *b, const struct statement *s) {
    struct argument a[N_ROW] = {0};
    if (!builder_plain(b, s, 0, 0, statement_output.usage) || !builder_once(b, &b->output, s) ||
        !deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1)) {
        return;
    }
    if (a[EVERY].given && a[INTERVAL].given) {
        deck_error(b->deck, &a[INTERVAL].key, "give -every or -interval, not both");
    }
    if (a[EVERY].given) {
        b->out.every = (int)a[EVERY].number[0];
    }
    if (a[INTERVAL].given) {
        b->out_interval = a[INTERVAL].number[0];
        b->output = a[INTERVAL].key;
    }
    if (a[FIELDS].given) {
        read_fields(b, &a[FIELDS]);
    }
    if (a[PRECISION].given) {
        read_precision(b, &a[PRECISION]);
    }
    if (a[COMPRESS].given) {
        b->out.compress = (int)a[COMPRESS].number[0];
    }
    if (a[HISTORIES].given) {
        b->out.of_runs = true;
        b->of_runs = a[HISTORIES].key;
    }
    if (a[FILE_NAME].given) {
        b->out.file = a[FILE_NAME].text[0];
    }
}

const struct statement_kind statement_output = {
    .name = "output",
    .usage = "[-every N | -interval DT] [-fields LIST] [-precision single] [-compress LEVEL] "
             "[-histories] [-file FILE]",
    .summary = "histories to write, and the result file",
    .example = "output -interval 0.02s -fields displacement force",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
