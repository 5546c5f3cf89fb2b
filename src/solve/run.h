// SPDX-License-Identifier: GPL-3.0-or-later
// An analysis under way, and the parts of the time loop that methods of integration and runs in
// lockstep share.
#ifndef JOSTLE_RUN_H
#define JOSTLE_RUN_H

#include "solve/account/account.h"
#include "solve/newmark/newmark.h"
#include "solve/pace.h"
#include "solve/work.h"

struct dp;
struct run;

// A method by which the time loop goes from row to row of the output.
struct method {
    // The models that are integrated by it.
    enum integrator integrator;
    bool adaptive;

    // What it carries from step to step, of struct run.
    const struct fields *fields;

    // Room for what it needs of the run; false: no memory.
    bool (*alloc)(struct run *r, struct arena *a);

    // Begins at r->now, the state at t = 0; NULL: nothing to do.
    void (*start)(struct run *r);

    // Goes from step *n of the model to a later one, `end` at most, and makes r->now its state.
    // Quantities that only rows show may be left out before `end`. STATUS_COLLAPSE: r->now is the
    // state at which the model has collapsed.
    int (*advance)(struct run *r, long *n, long end);

    // Computes what rows show of r->now and brings r->energy up to it; NULL: advance has done so.
    void (*complete)(struct run *r);

    // Makes its scratch that of the fields, which have been replaced; NULL: nothing to do.
    void (*resume)(struct run *r);
};

#define METHOD(descriptor) extern const struct method descriptor;
#include "solve/method_list.inc"
#undef METHOD

// What the adaptive steps of Newmark's method remember from step to step.
struct step_length {
    struct forcing forcing;  // for its corners
    struct scales scales;    // of errors
    struct pace pace;
    double trial;             // [T] what the error control would take next
    double last;              // [T] the step to the present state; 0: its accelerations jump there
    double split;             // [T] when a step was last split at an event
    bool turned;              // the forcing has a corner at the present state
    double *before, *within;  // [L/T^2] (n_dof) accelerations at the start of the last step: all of
                              // them, and without what the forcing does directly
};

struct run {
    const struct model *model;
    const struct method *method;
    const struct observer *observer;
    struct error *error;
    double start;  // [s] of the wall clock

    // What must be copied to go on from here with the same bits is in the lists of analysis.c and
    // of the method, and in the impacts. All else is scratch.
    long step;  // of the deck, that has been reached
    struct state *now, *next;
    struct energy_account energy;
    struct impact_log impacts;
    struct force_peaks forces;
    struct results *results;

    // Newmark's method, in run_step_fields.
    struct memory memory;
    int *events;                // (n_contact) at which the current step of the deck was split
    bool has_met;               // bodies have met at `now`, of which no peaks have been taken since
    struct work work;           // scratch, but for the factors
    struct step_length length;  // adaptive steps

    // Dormand & Prince's method, in dp_fields.
    struct dp *dp;

    // Scratch.
    struct state store[2];  // which `now` and `next` point to
    struct flight flight;
    double *row_force;              // [F] (n_link) of a row
    double *row_members;            // (model.n_force) of a row
    double *row_struck;             // [L] (n_dof) displacements of struck points of a row
    double *row_drift, *row_shear;  // [L] [F] (n_dof) the same of storeys, with any foundation
    struct meeting *meeting;        // (n_contact) of rigid impacts
};

// In analysis.c.

// Everything up to the state at t = 0 and its row. Not 0: as of analysis_run; analysis_end must be
// called all the same.
int analysis_begin(struct run *r, const struct model *m, const struct observer *observer,
                   struct error *e);

// Goes on to step `end` of the deck, with the rows on the way. Not 0: the same.
int analysis_go(struct run *r, long end);

// Step n of the deck (from 1), with its row, of a run with fixed steps. Not 0: the same.
int analysis_step(struct run *r, long n);

// Makes `to`, a run of the same model at any instant, go on as `from` will, to the last bit. Not 0:
// STATUS_SYSTEM (no memory).
int analysis_copy(struct run *to, const struct run *from);

// Raises the largest residual to that of the energies now in `results`. STATUS_FAILED: not finite.
int analysis_note_energies(struct run *r);

// Ends an analysis whose steps gave `status`, and returns that; if it is 0, *out has the results.
int analysis_end(struct run *r, int status, struct results **out);

// Asks the observer whether to go on, every so many steps or now. Not 0: stop.
enum { RUN_POLL_STEPS = 4096 };
int run_poll(struct run *r, double time);
int run_poll_now(struct run *r, double time);

// In run_step.c: steps of Newmark's method, fixed or adaptive.

extern const struct fields run_step_fields;

// Room for them; false: no memory.
bool run_step_alloc(struct run *r, struct arena *a);

// A step that is rejected is halved at most this often; 2^-30 of it is then taken as it is.
enum { RUN_HALVINGS_MAX = 30 };

// Steps to `end`, h later, or to the first event on the way; *rest is what is left of h.
// `halvings`: how often the step has been halved; at RUN_HALVINGS_MAX it is taken as it is.
// STATUS_RETRY: the step is rejected, and r->now as it was.
int run_step(struct run *r, double end, double h, int halvings, double *rest);

// `complete` and `resume` of struct method.
void run_step_complete(struct run *r);
void run_step_resume(struct run *r);

// Counts the events of each contact from 0 again.
void run_forget_events(struct run *r);

// An instant within a step at which a force or a velocity jumps.
struct event {
    int link;     // -1: none
    double time;  // [T] from the start of the step
};

// The first event in the step from `now` to `next` of size h; its time is exactly 0 or h if it is
// at an end. `count` (n_contact): events of each contact in this step of the deck so far. Link
// `except` is passed over; -1: none.
struct event run_step_first_event(const struct work *w, const struct state *now,
                                  const struct state *next, double h, const int *count, int except);

// In adaptive_newmark.c: does the step of size h from r->now to r->next meet the tolerance?
// STATUS_RETRY: no.
int adaptive_judge(struct run *r, double h);

// In collapse_newmark.c: if a storey reaches its limit of drift in the step to r->next, makes that
// the state at which it does, and sets r->results->collapse. STATUS_RETRY: the step that ends there
// is rejected.
int collapse_newmark(struct run *r);

// In fixed_newmark.c: step n of the deck (from 1), in as many steps as it takes.
int fixed_newmark_step(struct run *r, long n);

#endif
