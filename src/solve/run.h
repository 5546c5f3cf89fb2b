// SPDX-License-Identifier: GPL-3.0-or-later
// One analysis under way, for those who take its steps: analysis.c one after the other, ensemble.c
// those that it does not take in lanes.
#ifndef JOSTLE_RUN_H
#define JOSTLE_RUN_H

#include "solve/account.h"
#include "solve/work.h"

struct run {
    const struct model *model;
    const struct observer *observer;
    struct state *now, *next;
    struct state store[2];
    // Takes `now` to the time `end`, h later.
    int (*advance)(struct run *r, double end, double h);
    struct work work;     // of Newmark's method
    struct dp *adaptive;  // Dormand & Prince's method; NULL: Newmark's
    struct energy_account energy;
    struct impact_log impacts;
    int *events;              // (n_contact) at which the current step of the deck was split
    long events_before;       // totals.events at the start of it
    struct meeting *meeting;  // (n_contact) scratch of rigid impacts
    struct results *results;
    struct error *error;
    double start;  // [s] of the wall clock
};

// Everything up to the state at t = 0 and its row. Not 0: as of analysis_run; analysis_end must be
// called all the same.
int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e);

// Step n of the deck (from 1), with its row. The same.
int analysis_step(struct run *r, long n);

// Takes note of the energies of a row that have been put in `results`. STATUS_FAILED: not finite.
int analysis_balanced(struct run *r);

// Ends an analysis whose steps gave `status`, which it returns: *out has the results if it is 0.
int analysis_end(struct run *r, int status, struct results **out);

#endif
