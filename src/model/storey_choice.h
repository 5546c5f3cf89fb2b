// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with its options: `LAW -yield V -hardening R`. The statements `storey` and `hinges`
// share it.
#ifndef JOSTLE_STOREY_CHOICE_H
#define JOSTLE_STOREY_CHOICE_H

#include "model/builder.h"

struct storey_choice {
    const struct storey_law *law;
    struct argument given[STOREY_ROWS_MAX];  // (law->n_row)
    double *value[STOREY_ROWS_MAX];          // (n) of each row with numbers; NULL: others
    double *yield;                           // of the row `yield`; NULL: not given
    int yield_row;
};

// The law that the word names; NULL after a report that there is none.
const struct storey_law *storey_choice_find(struct builder *b, const struct word *name);

// Takes one value, or one for each of n laws, of each row of the choice. `owner` is as in
// builder_spread. False after a report.
bool storey_choice_spread(struct builder *b, struct storey_choice *c, int n, const char *owner);

// Law k of them, of this initial stiffness. False after a report at `w`.
bool storey_choice_prepare(struct builder *b, const struct word *w, const struct storey_choice *c,
                           int k, double stiffness, struct storey *out);

#endif
