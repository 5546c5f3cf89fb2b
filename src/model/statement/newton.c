// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/builder.h"

enum { TOLERANCE, ITERATIONS, N_ROW };

static const struct range tolerance_range = {
    .min = 1e-15, .max = 1e-2, .text = ">= 1e-15 and <= 0.01"};
static const struct range iterations_range = {
    .min = 1.0, .max = 1e6, .text = ">= 1 and <= 1000000"};

static const struct row rows[N_ROW] = {
    [TOLERANCE] = {"tolerance", ROW_NUMBER, 0, OF_NONE, &tolerance_range, 1e-12,
                   "change of a link force in the last iteration, relative to the largest force"},
    [ITERATIONS] = {"iterations", ROW_INTEGER, 0, OF_NONE, &iterations_range, 100,
                    "iterations before the step is rejected"},
};

static void build(struct builder *b, const struct statement *s) {
    struct argument a[N_ROW] = {0};
    bool good = builder_plain(b, s, 0, 0, statement_newton.usage) && builder_once(b, &b->newton, s);
    if (deck_options(b->deck, s, &(struct row_set){rows, N_ROW, a}, 1) && good) {
        b->tolerance = a[TOLERANCE].number[0];
        b->iterations = (int)a[ITERATIONS].number[0];
    }
}

const struct statement_kind statement_newton = {
    .name = "newton",
    .usage = "[-tolerance T] [-iterations N]",
    .summary = "convergence of the iteration for contact and storey forces",
    .example = "newton -tolerance 1e-12 -iterations 100",
    .row = rows,
    .n_row = N_ROW,
    .build = build,
};
