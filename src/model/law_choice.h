// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law with its options, as a statement names them: `LAW -k K -e E [-calibrate]`. Shared
// by the statement `contact` and the command `law`.
#ifndef JOSTLE_LAW_CHOICE_H
#define JOSTLE_LAW_CHOICE_H

#include "jostle/contact_law.h"
#include "jostle/deck.h"

struct law_choice {
    const struct contact_law *law;
    const struct word *word;                  // its name in the statement
    struct argument given[CONTACT_ROWS_MAX];  // (law->n_row)
    bool calibrated;                          // zeta was put in place of e
};

// The law called by the word; NULL after having reported that there is none.
const struct contact_law *law_choice_find(struct deck *d, const struct word *name);

// Options that go with every law.
enum { LAW_CHOICE_CALIBRATE, LAW_CHOICE_ROWS };
extern const struct row law_choice_rows[LAW_CHOICE_ROWS];

// Reads all options of `s`: those of the statement's own rows, of law_choice_rows and of the law.
// Reports what is wrong, then false.
bool law_choice_read(struct deck *d, const struct statement *s, const struct contact_law *law,
                     const struct word *name, const struct row_set *own, struct law_choice *out);

// The values of the law's rows and the constants that follow from them and the effective mass.
// Reports at the law's name what is wrong with them, then false.
bool law_choice_prepare(struct deck *d, const struct law_choice *c, double mass,
                        const double **value, const double **constant);

#endif
