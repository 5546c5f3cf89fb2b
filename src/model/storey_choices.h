// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with the options of a statement for several storeys or hinges, `LAW -yield LIST
// ...`: each has its own value of each row.
#ifndef JOSTLE_STOREY_CHOICES_H
#define JOSTLE_STOREY_CHOICES_H

#include "model/builder.h"
#include "model/storey_choice.h"

// The rows of the damage index, for the rows of the statement.
#define STOREY_CHOICES_DAMAGE(dimension)                                                           \
    {"damage-ultimate",                                                                            \
     ROW_LIST,                                                                                     \
     0,                                                                                            \
     dimension,                                                                                    \
     &range_positive,                                                                              \
     NAN,                                                                                          \
     "deformation at which a monotonic test loses its strength, for the damage index"},            \
    {                                                                                              \
        "damage-beta", ROW_LIST, 0, OF_NONE, &range_non_negative, NAN,                             \
            "weight of the energy in the damage index (default: 0.05)"                             \
    }

struct storey_choices {
    const struct storey_law *law;
    const struct argument *damage;              // (STOREY_DAMAGE_COUNT) of the rows above
    double *damage_value[STOREY_DAMAGE_COUNT];  // as `value`
    struct argument given[STOREY_ROWS_MAX];     // (law->n_row)
    double *value[STOREY_ROWS_MAX];             // (n) of each row that is given; NULL: others
    double *yield;                              // of the row `yield`; NULL: not given
    int yield_row;
};

// Spreads the given options of these rows over n laws: value[r] (n), flags as 1. `owner` is as in
// builder_spread. False after a report.
bool storey_choices_rows(struct builder *b, const struct row *row, int n_row,
                         const struct argument *given, int n, const char *owner, double **value);

// Takes one value, or one for each of n laws, of each row of the choice. `owner` is as in
// builder_spread. False after a report.
bool storey_choices_spread(struct builder *b, struct storey_choices *c, int n, const char *owner);

// The law with these values of its rows (NAN: not given) and this initial stiffness. False after a
// report at `w`.
bool storey_choices_law(struct builder *b, const struct word *w, const struct storey_law *law,
                        const double *value, double stiffness, struct storey *out);

// Law k of them, of this initial stiffness. False after a report at `w`.
bool storey_choices_prepare(struct builder *b, const struct word *w, const struct storey_choices *c,
                            int k, double stiffness, struct storey *out);

#endif
