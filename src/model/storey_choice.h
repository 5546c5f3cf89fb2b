// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with the options of a statement, `LAW -yield V ...`, for one storey.
#ifndef JOSTLE_STOREY_CHOICE_H
#define JOSTLE_STOREY_CHOICE_H

#include "jostle/deck.h"
#include "jostle/storey_law.h"

struct storey_choice {
    const struct storey_law *law;
    const struct word *word;                 // its name in the statement
    struct argument given[STOREY_ROWS_MAX];  // (law->n_row)
    double stiffness;                        // initial
    double value[STOREY_ROWS_MAX];           // of the rows; NAN: not given
    double constant[STOREY_CONSTANTS_MAX];
};

// The law that the word names; NULL after a report that there is none.
const struct storey_law *storey_choice_find(struct deck *d, const struct word *name);

// The same where no storey has the law: a law that depends on the velocity is reported, too.
const struct storey_law *storey_choice_find_rateless(struct deck *d, const struct word *name);

// The place of the law's row; -1: it has none of this name.
int storey_choice_row(const struct storey_law *law, const char *key);

// The rows of the law (law->n_row) as one of moment and rotation: forces become moments, and
// lengths become angles.
void storey_choice_turn(const struct storey_law *law, struct row *row);

// Reads the options of `s`, those of `own` and of the law, and sets the values. Rows for which
// `found` holds need not be given; NULL: none. `of` has the rows of the law, which may be turned.
// False after a report.
bool storey_choice_read(struct deck *d, const struct statement *s, const struct storey_law *law,
                        const struct row *of, const struct row_set *own, const bool *found,
                        struct storey_choice *out);

// Computes the constants. False after a report at the name of the law.
bool storey_choice_prepare(struct deck *d, struct storey_choice *c);

#endif
