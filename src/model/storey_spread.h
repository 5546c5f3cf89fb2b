// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with its options for several storeys or hinges: `LAW -yield LIST -hardening R`.
#ifndef JOSTLE_STOREY_SPREAD_H
#define JOSTLE_STOREY_SPREAD_H

#include "model/builder.h"

struct storey_spread {
    const struct storey_law *law;
    struct argument given[STOREY_ROWS_MAX];  // (law->n_row)
    double *value[STOREY_ROWS_MAX];          // (n) of each row with numbers; NULL: others
    double *yield;                           // of the row `yield`; NULL: not given
    int yield_row;
};

// Takes one value, or one for each of n laws, of each row. `owner` is as in
// builder_spread. False after a report.
bool storey_spread_take(struct builder *b, struct storey_spread *c, int n, const char *owner);

// Law k of them, of this initial stiffness. False after a report at `w`.
bool storey_spread_prepare(struct builder *b, const struct word *w, const struct storey_spread *c,
                           int k, double stiffness, struct storey *out);

#endif
