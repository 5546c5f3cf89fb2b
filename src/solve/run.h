// SPDX-License-Identifier: GPL-3.0-or-later
// An analysis under way, in analysis.c, and its steps, in run_step.c: for those who take them one
// after the other, in lanes but for some, or of other lengths.
#ifndef JOSTLE_RUN_H
#define JOSTLE_RUN_H

#include "solve/energy.h"
#include "solve/flight.h"
#include "solve/impacts.h"
#include "solve/step_length.h"
#include "solve/work.h"

struct dp;
struct method;

struct run {
    const struct model *model;
    const struct method *method;
    const struct observer *observer;
    struct state *now, *next;
    struct state store[2];
    struct energy_account energy;
    struct impact_log impacts;
    struct results *results;
    struct error *error;
    double *row_force;  // [F] (n_link) scratch of a row
    double start;       // [s] of the wall clock

    // Newmark's method.
    struct work work;
    struct flight flight;       // fixed steps
    struct step_length length;  // adaptive steps
    int *events;                // (n_contact) at which the current step of the deck was split
    long events_before;         // totals.events at the start of it
    struct meeting *meeting;    // (n_contact) scratch of rigid impacts

    struct dp *dp;  // Dormand & Prince's method
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

// Steps between two questions to the observer whether to go on, and the question: if it is time,
// and now.
enum { RUN_POLL_STEPS = 4096 };
int run_poll(struct run *r, double time);
int run_poll_now(struct run *r, double time);

// Room for steps of Newmark's method; false: no memory.
bool run_step_alloc(struct run *r, struct arena *a);

// Steps to `end`, h later, or to the first event on the way; *rest is what is left of h. A step of
// so many `cuts` is taken as it is where it cannot be cut. STATUS_RETRY: a shorter one is wanted.
int run_step(struct run *r, double end, double h, int cuts, double *rest);

// A step that is not solved is halved at most this often; 2^-30 of it is then taken as it is.
enum { RUN_CUTS_MAX = 30 };

// What struct method asks for, of such steps.
void run_step_complete(struct run *r);
void run_step_finish(struct run *r);

// Starts to count the events of each contact anew, if there were any.
void run_forget_events(struct run *r);

// Step n of the deck (from 1), of a run with fixed steps, by one or as many as it takes.
int fixed_newmark_step(struct run *r, long n);

#endif
