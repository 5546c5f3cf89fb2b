// SPDX-License-Identifier: GPL-3.0-or-later
// A storey law with the options of a statement, `LAW -yield V ...`, for one storey.
#ifndef JOSTLE_STOREY_CHOICE_H
#define JOSTLE_STOREY_CHOICE_H

#include "jostle/deck.h"
#include "law/loop_law.h"

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

// The place of the law's row; -1: it has none of this name.
int storey_choice_row(const struct storey_law *law, const char *key);

// n rows of a law as those of one of moment and rotation: forces become moments, and lengths become
// angles.
void storey_choice_turn(const struct row *from, int n, struct row *row);

// Reads the options of `s`, those of `own` and the n_row rows `of` of the law, and sets the values.
// Rows for which `found` holds need not be given; NULL: none. False after a report.
bool storey_choice_read(struct deck *d, const struct statement *s, const struct row *of, int n_row,
                        const struct row_set *own, const bool *found, struct storey_choice *out);

#endif
