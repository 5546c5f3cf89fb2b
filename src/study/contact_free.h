// SPDX-License-Identifier: GPL-3.0-or-later
// How near the buildings of a deck come to each other when they never touch, run by run, next to
// the separations that building codes and the literature make of their largest displacements.
#ifndef JOSTLE_CONTACT_FREE_H
#define JOSTLE_CONTACT_FREE_H

#include "study/gap_runs.h"

// What is known of the two sides where they face each other. Of a wall the displacement is 0.
struct separation_ends {
    double displacement[2];  // [L] the largest absolute ones: left, right
    double period[2];        // [T] of the first modes; infinite: a free body
    double damping[2];       // ratios of the first modes
    double level[2];         // [L] above the grounds; NAN: not given
    double height[2];        // [L] of the buildings; NAN: not given; infinite: a wall
};

// What rules take from the user.
struct separation_site {
    const double *factor;  // (n_building) of displacements; NULL: all are 1
    double metre;          // [L] 1 m
    double gb_step;        // [m] of height for 20 mm more, after GB 50011; 0: not asked for
    double gb_share;       // of its width for frames
    double ntc_slope;      // of the level, after NTC; NAN: not asked for
};

struct separation_rule {
    const char *key;      // in a table separated by tabs
    const char *name;     // in a table to be read
    const char *formula;  // of uA, uB and rho
    const char *source;
    double (*separation)(const struct separation_ends *e, double rho,
                         const struct separation_site *s);  // [L]
};

// The first SEPARATION_GENERAL rules need nothing of the site.
enum { SEPARATION_GENERAL = 4, SEPARATION_GB = SEPARATION_GENERAL, SEPARATION_NTC };
enum { SEPARATION_RULES = SEPARATION_NTC + 1 };
extern const struct separation_rule contact_free_rules[SEPARATION_RULES];

// Correlation coefficient of the responses of two oscillators to the same white noise; NAN where a
// period is infinite, or damping negative.
double contact_free_correlation(const double period[2], const double damping[2]);

// By one of the rules. NAN where it needs a correlation or height that does not exist.
double contact_free_separation(const struct separation_rule *rule,
                               const struct separation_ends *ends,
                               const struct separation_site *site);

// What a run gives for a contact.
enum contact_free_value {
    FREE_GAP,            // [L] of the deck
    FREE_CLOSING,        // [L] largest x_left - x_right at the floors of the contact
    FREE_LEFT,           // [L] largest |u| of the left floor; 0 of a wall
    FREE_RIGHT,          // [L]
    FREE_PERIOD_LEFT,    // [T] of the first mode of the building alone; NAN of a wall
    FREE_PERIOD_RIGHT,   // [T]
    FREE_DAMPING_LEFT,   // ratio of that mode
    FREE_DAMPING_RIGHT,  //
    FREE_RHO,            // correlation coefficient of these modes
    FREE_LEVEL_LEFT,     // [L] of the contact above the ground; NAN: not given
    FREE_LEVEL_RIGHT,    // [L]
    FREE_HEIGHT_LEFT,    // [L] of the building; NAN: not given; infinite: a wall
    FREE_HEIGHT_RIGHT,   // [L]
    FREE_RULE,           // [L] separations by the rules
    FREE_VALUES = FREE_RULE + SEPARATION_RULES
};

struct contact_free {
    long n_run, n_failed;
    int n_contact;
    struct study_outcome *outcome;  // (n_run)
    double *value;                  // (n_run, n_contact, FREE_VALUES)
    bool idle[STUDY_SWEEPS_MAX];    // sweeps that change nothing but the gaps: a swept gap, say
    bool *counts;                   // (n_run) false: the same as an earlier run, but for gaps
};

// Runs all runs of the plan with its contacts open; bilateral links act. *out must be given to
// contact_free_close, whatever happens. Errors as of gap_runs_run.
int contact_free_run(const struct plan *plan, const struct gap_runs *how,
                     const struct separation_site *site, struct contact_free *out, struct error *e);
void contact_free_close(struct contact_free *a);

// The values (FREE_VALUES) of a contact in a run.
const double *contact_free_values(const struct contact_free *a, long run, int contact);

// Of the runs that count and did not fail; NAN if all have.
struct contact_free_summary {
    double mean, low, median, high;  // percentiles 16, 50, 84
    double least, largest;
    long run;  // of the largest
};

// The summary of a value of a contact, or of its ratio to `below` where that is > 0 (FREE_VALUES:
// as it is); `scratch` has room for n_run.
struct contact_free_summary contact_free_summarise(const struct contact_free *a, int contact,
                                                   int value, int below, double *scratch);

// Runs, all of them, in which the closing displacement is beyond the deck's gap.
long contact_free_hits(const struct contact_free *a, int contact);

#endif
