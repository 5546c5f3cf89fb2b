// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/builder.h"

enum { BETA, GAMMA, N_NEWMARK_ROW };

// With gamma < 1/2 the method adds energy in each step. Values of gamma above 1 and larger values
// of beta have no advantage.
static const struct range beta_range = {.min = 0.0, .max = 1.0, .text = ">= 0 and <= 1"};
static const struct range gamma_range = {.min = 0.5, .max = 1.0, .text = ">= 0.5 and <= 1"};

static const struct row newmark_rows[N_NEWMARK_ROW] = {
    [BETA] = {"beta", ROW_NUMBER, 0, OF_NONE, &beta_range, 0.25,
              "0 is explicit, 1/6 is linear acceleration"},
    [GAMMA] = {"gamma", ROW_NUMBER, 0, OF_NONE, &gamma_range, 0.5,
               "above 1/2 there is numerical damping"},
};

enum { N_VARIANT = 2 };
static const struct statement_variant variants[N_VARIANT] = {
    [INTEGRATOR_NEWMARK] = {"newmark", "order 2, implicit, with fixed and adaptive steps",
                            newmark_rows, N_NEWMARK_ROW},
    [INTEGRATOR_DORMAND_PRINCE] = {"dormand-prince", "order 5(4), explicit, with step adaptive",
                                   NULL, 0},
};

static void build(struct builder *b, const struct statement *s) {
    struct argument a[N_NEWMARK_ROW] = {0};
    if (!builder_plain(b, s, 1, 1, statement_integrator.usage) ||
        !builder_once(b, &b->integrator, s)) {
        return;
    }
    const int variant = builder_variant(b, &s->word[1], "integrator", &statement_integrator);
    if (variant == INTEGRATOR_DORMAND_PRINCE) {
        b->method = INTEGRATOR_DORMAND_PRINCE;
        deck_options(b->deck, s, NULL, 0);
    } else if (variant == INTEGRATOR_NEWMARK &&
               deck_options(b->deck, s, &(struct row_set){newmark_rows, N_NEWMARK_ROW, a}, 1)) {
        b->beta = a[BETA].number[0];
        b->gamma = a[GAMMA].number[0];
    }
}

const struct statement_kind statement_integrator = {
    .name = "integrator",
    .usage = "newmark [-beta B] [-gamma G] | dormand-prince",
    .summary = "time integration; default: newmark with average acceleration; with step adaptive "
               "dormand-prince, or newmark if a damper has an exponent below 0.5",
    .example = "integrator newmark -beta 0.25 -gamma 0.5",
    .variant = variants,
    .n_variant = N_VARIANT,
    .build = build,
};
