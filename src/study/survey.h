// SPDX-License-Identifier: GPL-3.0-or-later
// A look at the models of a study before it runs: are all of its files and values usable, which
// run is the strongest, and in which run is each contact softest? The strongest run is that with
// the shortest bound on its step (guidance.h), of several the one whose contacts close fastest, and
// then the one whose Rayleigh damping carries most of the yield force of a storey.
// A contact is softest where its stiffness over that of the stiffest storey beside it is smallest.
//
// All runs would be too many. The survey varies one sweep at a time, those of numbers first, and
// keeps the strongest value while it varies the next one. Then it takes all combinations of the
// sweeps of texts, which name files and laws. Of more than SURVEY_VALUES numbers it takes so many,
// evenly spread, with the smallest and the largest. Combinations of texts beyond
// SURVEY_COMBINATIONS are varied one sweep at a time, too.
#ifndef JOSTLE_SURVEY_H
#define JOSTLE_SURVEY_H

#include "model/guidance.h"
#include "study/plan.h"

enum { SURVEY_VALUES = 64, SURVEY_COMBINATIONS = 2000 };

// An error of one or more runs.
struct survey_error {
    const char *message;
    long run;     // the first with it
    long n_more;  // further ones
    struct survey_error *next;
};

struct survey {
    const struct plan *plan;  // borrowed
    struct arena *arena;      // owned
    struct survey_error *error, *last;
    long n_run;                        // models that were built
    long n_failed;                     // of them, those with an error
    long n_file;                       // different files that they read, the deck not among them
    long strongest;                    // run; 0 where all models have errors
    double bound;                      // [T] on its step; infinite: no run asks for one
    double velocity;                   // [L/T] at which the fastest of its contacts closes
    int n_contact;                     // of each run; guidance.h estimates no more
    struct guidance_contact *softest;  // (n_contact) each from the run where it is softest
    long *softest_run;                 // (n_contact)
    struct damping_finding damped;     // of the run whose dashpots carry most of the yield force
    long damped_run;
};

// Builds the models and finds out. Errors of runs are results. Errors: STATUS_SYSTEM.
// *s is to be given to survey_close, whatever happens.
int survey_run(struct survey *s, const struct plan *p, struct error *e);
void survey_close(struct survey *s);

// Hands the model of the strongest run and the advice for it to `use`.
int survey_strongest(const struct survey *s,
                     void (*use)(void *context, const struct model *m, const struct guidance *g),
                     void *context, struct error *e);

// Have all runs the same floors and links? Builds all models where there are at most
// SURVEY_COMBINATIONS, else that of run 1 with each value of each sweep. A deck in which no word
// that could change them depends on a sweep (deck.varies) needs no such look.
// A model with another error passes. Errors: STATUS_INPUT (they have not), STATUS_SYSTEM.
int survey_shapes(const struct plan *p, struct error *e);

#endif
