// SPDX-License-Identifier: GPL-3.0-or-later
#include <string.h>

#include "model/statement.h"

enum { BETA, GAMMA, N_ROW };

// Below 1/2 gamma feeds energy in at any step; above 1 and for larger beta nothing is gained.
static const struct range beta_range = {.min = 0.0, .max = 1.0, .text = ">= 0 and <= 1"};
static const struct range gamma_range = {.min = 0.5, .max = 1.0, .text = ">= 0.5 and <= 1"};

static const struct row rows[N_ROW] = {
    [BETA] =
        {"beta", ROW_NUMBER, 0, {0}, &beta_range, 0.25, "0: explicit, 1/6: linear acceleration"},
    [GAMMA] = {"gamma", ROW_NUMBER, 0, {0}, &gamma_range, 0.5, "above 1/2: numerical damping"},
};

static void build(struct builder *b, const struct statement *s) {
    static const char *const known[] = {"newmark"};
    struct argument a[N_ROW] = {0};
    bool good =
        builder_plain(b, s, 1, 1, statement_integrator.usage) && builder_once(b, &b->integrator, s);
    if (good && strcmp(s->word[1].text, "dormand-prince") == 0) {
        deck_error(b->deck, &s->word[1],
                   "dormand-prince is not available in this version; use newmark");
        return;
    }
    if (good && strcmp(s->word[1].text, known[0]) != 0) {
        deck_unknown(b->deck, &s->word[1], "integrator", known, 1);
        return;
    }
    if (deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) && good) {
        b->beta = a[BETA].number[0];
        b->gamma = a[GAMMA].number[0];
    }
}

const struct statement_kind statement_integrator = {
    .name = "integrator",
    .usage = "newmark [-beta B] [-gamma G]",
    .summary = "how the equations of motion are integrated; default: average acceleration",
    .example = "integrator newmark -beta 0.25 -gamma 0.5",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
