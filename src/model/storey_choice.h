// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with the options of a statement, `LAW -yield V ...`, for one storey.
#ifndef JOSTLE_STOREY_CHOICE_H
#define JOSTLE_STOREY_CHOICE_H

#include "jostle/deck.h"
#include "law/storey_loop.h"
#include "model/builder.h"

struct storey_choice {
    const struct storey_law *law;          // NULL: another law, or none
    const struct word *word;               // the name of the law in the statement
    struct argument given[LOOP_ROWS_MAX];  // (n_row)
    double value[LOOP_ROWS_MAX];           // of the rows; NAN: not given
};

// The law that the word names; NULL after a report that there is none.
const struct storey_law *storey_choice_find(struct deck *d, const struct word *name);

// The same where no storey has the law: a law that depends on the velocity is reported, too.
const struct storey_law *storey_choice_find_rateless(struct deck *d, const struct word *name);

// The law of a link that the word names; false after a report that there is none.
bool storey_choice_find_link(struct deck *d, const struct word *name, struct link_law *out);

// The n rows `from` of a law, for a law of moment and rotation: forces become moments, and lengths
// become angles.
void storey_choice_turn(const struct row *from, int n, struct row *row);

// Reads the options of `s`, those of `own` and the n_row rows `of` of the law, and sets the values.
// Rows for which `found` holds need not be given; NULL: none. False after a report.
bool storey_choice_read(struct deck *d, const struct statement *s, const struct row *of, int n_row,
                        const struct row_set *own, const bool *found, struct storey_choice *out);

// The same for several storeys or hinges, `LAW -yield LIST ...`: each has its own value of each
// row.

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

// Marks that storey i (from 0) has a law from statement `s`; false after a report if it had one.
bool storey_choices_take(struct builder *b, struct building_draft *d, int i,
                         const struct statement *s);

// Marks storey i (from 0) as an isolator; false after a report at `w` if another one of the
// building is.
bool storey_choices_isolate(struct builder *b, struct building_draft *d, int i,
                            const struct word *w);

#endif
