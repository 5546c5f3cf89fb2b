// SPDX-License-Identifier: GPL-3.0-or-later
// How near the buildings of a deck come to each other when they never touch, run by run, next to
// what rules make of their displacements.
#ifndef JOSTLE_APART_H
#define JOSTLE_APART_H

#include "study/gap_runs.h"
#include "study/separation.h"

// What a run gives for a contact.
enum apart_value {
    APART_GAP,            // [L] of the deck
    APART_CLOSING,        // [L] largest x_left - x_right at the floors of the contact
    APART_LEFT,           // [L] largest |u| of the left floor; 0 of a wall
    APART_RIGHT,          // [L]
    APART_PERIOD_LEFT,    // [T] of the first mode of the building alone; NAN of a wall
    APART_PERIOD_RIGHT,   // [T]
    APART_DAMPING_LEFT,   // ratio of that mode
    APART_DAMPING_RIGHT,  //
    APART_RHO,            // correlation coefficient of these modes
    APART_RULE,           // [L] separations by the rules
    APART_VALUES = APART_RULE + SEPARATION_RULES
};

struct apart {
    long n_run, n_failed;
    int n_contact;
    struct study_outcome *outcome;  // (n_run)
    double *value;                  // (n_run, n_contact, APART_VALUES)
    bool idle[STUDY_SWEEPS_MAX];    // sweeps that change nothing but the gaps: a swept gap, say
    bool *counts;                   // (n_run) false: the same as another run, but for these
};

// Runs all runs of the plan with its contacts open; bilateral links act. *out must be given to
// apart_close, whatever happens. Errors as of gap_runs_run.
int apart_run(const struct plan *plan, const struct gap_runs *how, struct apart *out,
              struct error *e);
void apart_close(struct apart *a);

// The values (APART_VALUES) of a contact in a run.
const double *apart_values(const struct apart *a, long run, int contact);

// Of the runs that count and did not fail; NAN if all have.
struct apart_summary {
    double mean, low, median, high;  // percentiles 16, 50, 84
    double least, largest;
    long run;  // of the largest
};

// The summary of a value of a contact, or of its ratio to `below` where that is > 0 (APART_VALUES:
// as it is); `scratch` has room for n_run.
struct apart_summary apart_summarise(const struct apart *a, int contact, int value, int below,
                                     double *scratch);

// Runs, all of them, in which the closing displacement is beyond the deck's gap.
long apart_hits(const struct apart *a, int contact);

#endif
