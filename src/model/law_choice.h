// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law with the options of a statement: `LAW -k K -e E [-calibrate]`. The statement
// `contact` and the command `law` share it.
#ifndef JOSTLE_LAW_CHOICE_H
#define JOSTLE_LAW_CHOICE_H

#include "jostle/contact_law.h"
#include "jostle/deck.h"

struct law_choice {
    const struct contact_law *law;
    const struct word *word;                  // its name in the statement
    struct argument given[CONTACT_ROWS_MAX];  // (law->n_row)
    struct curve curve;                       // of the row of kind ROW_FILE; n = 0 without one
    double restitution;                       // requested coefficient; NAN: none
    bool calibrated;                          // the damping delivers it exactly
};

// The law that the word names; NULL after a report that there is none.
const struct contact_law *law_choice_find(struct deck *d, const struct word *name);

// Options of all laws.
enum { LAW_CHOICE_CALIBRATE, LAW_CHOICE_K_FROM, LAW_CHOICE_ROWS };
extern const struct row law_choice_rows[LAW_CHOICE_ROWS];

// Reads all options of `s`: those of the statement's own rows, of law_choice_rows, of the law, and
// of the estimate of stiffness that -k-from names. Reads the file of the law's curve, too. False
// after a report.
bool law_choice_read(struct deck *d, const struct statement *s, const struct contact_law *law,
                     const struct word *name, const struct row_set *own, struct law_choice *out);

// The value of the row that is the exponent in dimensions of other rows; 0: there is no such row.
double law_choice_power(const struct law_choice *c);

// Computes the values of the law's rows (contact_law_n_value) and, with the effective mass, its
// constants (contact_law_n_constant). False after a report at the name of the law.
bool law_choice_prepare(struct deck *d, const struct law_choice *c, double mass,
                        const double **value, const double **constant);

// Estimates of the contact stiffness from the bodies that meet, for `-k-from`.

// Options of the estimates, for help texts.
enum { STIFFNESS_HERTZ_ROWS = 6, STIFFNESS_SLAB_ROWS = 3, STIFFNESS_ROWS_MAX = 8 };
extern const struct row stiffness_hertz_rows[STIFFNESS_HERTZ_ROWS];
extern const struct row stiffness_slab_rows[STIFFNESS_SLAB_ROWS];

struct stiffness_estimate {
    const char *name;
    const struct row *row;
    int n_row;
    struct dimension dimension;                         // of the stiffness
    double (*stiffness)(const struct argument *given);  // in the deck's units
};
extern const struct stiffness_estimate stiffness_estimates[];
extern const int n_stiffness_estimate;

// The estimate that the word names; NULL after a report that there is none.
const struct stiffness_estimate *stiffness_estimate_find(struct deck *d, const struct word *name);

#endif
