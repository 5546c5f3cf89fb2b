// SPDX-License-Identifier: GPL-3.0-or-later
// The runs of two studies beside each other. Two runs are a pair if all parameters that both
// studies sweep have the same values. A sweep that has one value in each study distinguishes the
// studies and does not count.
#ifndef JOSTLE_RUN_PAIRS_H
#define JOSTLE_RUN_PAIRS_H

#include "core/arena.h"
#include "study/edp.h"

struct run_pair {
    long row[2];  // of both files
};

struct run_pairs {
    struct arena *arena;
    struct study_file *file[2];        // borrowed
    const struct study_view *view[2];  // of them
    const char *matched;               // "record, pga"; "": no parameter
    long n;
    struct run_pair *pair;  // (n) in the order of the first file
    long n_only[2];         // runs of each file that the other one does not have
};

// Finds the pairs. If a study has runs of several values of another sweep for one run of the other
// study, each of them is a pair with it. *p must be given to run_pairs_close, whatever happens.
// Errors: STATUS_INPUT (there are no pairs, or both studies have several runs that would match),
// STATUS_SYSTEM.
int run_pairs_open(struct run_pairs *p, struct study_file *first, struct study_file *second,
                   struct error *e);
void run_pairs_close(struct run_pairs *p);

// The ratios of a demand of the first study over that of the second one.
struct run_ratios {
    const char *text;   // of the demand
    struct edp edp[2];  // as the files have it
    double *value[2];   // (n) of the pairs, in the unit of the first file; from the arena
    long n;             // pairs whose values are both positive and finite; others do not count
    double median, dispersion;  // of the ratios: the latter of the logarithms; NAN: n < 2
    double smallest, largest;
    long at_smallest, at_largest;  // pairs
};

// Reads the demand `text`, NULL: the usual one, of all pairs. Errors: STATUS_INPUT (a file does not
// have it), STATUS_SYSTEM.
int run_pairs_read(const struct run_pairs *p, const char *text, struct run_ratios *out,
                   struct error *e);

#endif
