// SPDX-License-Identifier: GPL-3.0-or-later
// What a study runs: the deck, read again for each run with other values of its sweeps. Runs are
// numbered from 0; the last sweep of the deck varies fastest.
#ifndef JOSTLE_PLAN_H
#define JOSTLE_PLAN_H

#include "core/arena.h"
#include "jostle/study.h"
#include "jostle/study_file.h"

struct plan {
    const struct model *first;  // borrowed: the model of run 0
    const char *const *define;  // (n_define) borrowed
    int n_define;
    long n_run;                 // of the study
    struct study_shard shard;   // what is run of it
    long n_mine;                // runs of that
    struct report *report;      // owned: of the first model, before its run
    struct study_table *table;  // owned
};

// Errors: STATUS_SYSTEM (no memory).
int plan_init(struct plan *p, const struct study_request *q, struct error *e);
void plan_close(struct plan *p);

// The plan of the same deck with another -D, NAME=VALUE, on top. `define` is borrowed. The values
// of its runs have the places of those of `p`. *out is to be given to plan_close_with, whatever
// happens. Errors: STATUS_INPUT (the deck has an error with that value, or another shape),
// STATUS_SYSTEM.
int plan_open_with(const struct plan *p, const char *define, struct plan *out, struct error *e);
void plan_close_with(struct plan *p);

// The value that each sweep takes in a run, fixed ones included; room for STUDY_SWEEPS_MAX.
void plan_choose(const struct plan *p, long run, int *choice);

// "run 7 (gap = 0.02, record = ELCENTRO)", cut to fit; runs are counted from 1 here.
struct plan_text {
    char text[256];
};
const char *plan_describe(const struct plan *p, long run, struct plan_text *t);

// Checks that a model is one of this study: the same sweeps, units, buildings, floors, contacts and
// links as the first. Errors: STATUS_INPUT, which names the run and the difference.
int plan_check(const struct plan *p, long run, const struct model *m, struct error *e);

// The same without the sweeps: whether its values have the places of those of the first model.
int plan_check_shape(const struct plan *p, long run, const struct model *m, struct error *e);

enum { PLAN_PAIRED_MAX = 64 };

// The runs of a plan that are left when sweeps are fixed, each at one value, as by a -D. It points
// into itself and must not be copied.
struct plan_fixed {
    struct sweep sweep[STUDY_SWEEPS_MAX], paired[PLAN_PAIRED_MAX];
    struct deck deck;
    struct model model;
    struct plan plan;  // not to be closed
};

// The one number of a sweep; NULL: the sweep stays as it is. Of sweeps that are paired all are
// fixed, or none. The number must stay where it is.
typedef const double *plan_fixed_at(const void *context, const struct sweep *s);

// At most PLAN_PAIRED_MAX of the sweeps that are fixed are paired.
void plan_fix(const struct plan *p, plan_fixed_at *at, const void *context, struct plan_fixed *out);

// What a result file of these runs would say of their values, for demands that are parsed before
// there is one. It borrows from the plan.
struct study_view plan_view(const struct plan *p);

#endif
