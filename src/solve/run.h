// SPDX-License-Identifier: GPL-3.0-or-later
// An analysis under way, in analysis.c, and its steps, in run_step.c: for those who take them one
// after the other, in lanes but for some, or of other lengths.
#ifndef JOSTLE_RUN_H
#define JOSTLE_RUN_H

#include "solve/dormand_prince.h"
#include "solve/energy.h"
#include "solve/flight.h"
#include "solve/impacts.h"
#include "solve/step_length.h"
#include "solve/work.h"

struct run {
    const struct model *model;
    const struct observer *observer;
    struct state *now, *next;
    struct state store[2];
    // Takes `now` to the time `end`, h later.
    int (*advance)(struct run *r, double end, double h);
    struct work work;           // of Newmark's method
    struct flight flight;       // of fixed steps
    struct step_length length;  // of its adaptive steps
    struct dp *adaptive;        // Dormand & Prince's method; NULL: Newmark's
    struct energy_account energy;
    struct impact_log impacts;
    int *events;              // (n_contact) at which the current step of the deck was split
    long events_before;       // totals.events at the start of it
    struct meeting *meeting;  // (n_contact) scratch of rigid impacts
    struct results *results;
    struct error *error;
    double *row_force;  // [F] (n_link) scratch of a row
    double start;       // [s] of the wall clock
};

// Everything up to the state at t = 0 and its row. Not 0: as of analysis_run; analysis_end must be
// called all the same.
int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e);

// Step n of the deck (from 1), with its row, of a run with fixed steps. The same.
int analysis_step(struct run *r, long n);

// Takes note of the energies of a row that have been put in `results`. STATUS_FAILED: not finite.
int analysis_note_energies(struct run *r);

// Ends an analysis whose steps gave `status`, which it returns: *out has the results if it is 0.
int analysis_end(struct run *r, int status, struct results **out);

// Steps between two questions to the observer whether to go on, and the question, if it is time.
enum { RUN_POLL_STEPS = 4096 };
int run_poll(struct run *r, double time);

// Steps to `end`, h later, or to the first event on the way; *rest is what is left of h. A step of
// so many `cuts` is taken as it is where it cannot be cut. STATUS_RETRY: a shorter one is wanted.
int run_step(struct run *r, double end, double h, int cuts, double *rest);

// Goes to `end`, h later, by one step or as many as it takes.
int run_advance_fixed(struct run *r, double end, double h);

// Starts to count the events of each contact anew, if there were any.
void run_forget_events(struct run *r);

#endif
