// SPDX-License-Identifier: GPL-3.0-or-later
// The accounts of a run: energies, impacts, the largest values over all computed steps, and what
// yielding parts have gone through.
#ifndef JOSTLE_ACCOUNT_H
#define JOSTLE_ACCOUNT_H

#include <math.h>

#include "solve/event/event.h"
#include "solve/state.h"

// The account of energy: works since t = 0, and what a state holds.

// Works since t = 0 [F L], each the sum over steps of a mean force times a displacement.
struct energy_account {
    double initial;  // kinetic, strain and contact energy at t = 0
    // Twice the work of external and damping forces: floor i of the chain adds to element i %
    // LANES_WIDTH, and in a step the lower floor first.
    double input_2x[LANES_WIDTH], damping_2x[LANES_WIDTH];
    double input, damping;  // other work: of links on the grounds, and of Dormand & Prince's steps
    double contact;
    double storey;        // work on storeys that are not elastic, beyond that of the arrays
    double stored_start;  // their recoverable energy at t = 0
    double *storey_2x;    // (n_dof) twice the work on storeys, where some are not elastic
    double *storey_own;   // (n_dof) work on storeys in steps of Dormand & Prince
};
extern const struct fields energy_fields;

// Energies of the start state. That of closed links, which is both initial energy and work done on
// them, also goes to each link's own in `link` (n_link). Errors: STATUS_SYSTEM (no memory).
int energy_start(struct energy_account *a, const struct model *m, const struct state *s,
                 struct link_peak *link, struct error *e);

// Adds the losses of rigid contacts that met at the instant of `s`. `meeting` is (n_contact).
void energy_meet(struct energy_account *a, const struct model *m, const struct state *s,
                 const struct meeting *meeting);

// What the account needs of a state: sums over all floors.
struct energy_sums {
    double kinetic;               // [F L]
    double elastic, other;        // [F L] stored in elastic storeys, and in others
    double storey;                // [F L] work so far on those, but for
    double damped;                // [F L] that of viscous forces of parts
    double input_2x, damping_2x;  // [F L] twice the work of external and damping forces so far
};

struct energy_sums energy_sums_of(const struct energy_account *a, const struct model *m,
                                  const struct state *s);

// The account with the sums of a state, into energy (ENERGY_COUNT).
void energy_close(const struct energy_account *a, const struct energy_sums *sums, double *energy);

// The account of impacts, and of the totals of links, from step to step.

struct impact_log {
    const struct model *model;      // borrowed, as are the next two
    struct results *results;        // where impacts and the totals of links go
    struct energy_account *energy;  // where the work of links goes
    long *open;  // (n_contact) index into results.impact of the impact under way; -1: none
};

// What one step adds to a link.
struct impact_share {
    double impulse, work;       // [F T] [F L]
    double force, penetration;  // [F] [L] largest
    long steps;                 // 1 if it counts as a step in contact
};

// Room for the log of a model; false: no memory.
bool impacts_alloc(struct impact_log *log, const struct model *m, struct results *r,
                   struct energy_account *energy, struct arena *a);

// Makes the impacts of `to`, a run of the same model, those of `from`; false: no memory.
bool impacts_copy(struct impact_log *to, const struct impact_log *from);

// The following give STATUS_SYSTEM (no memory) where they return a status.

// Opens an impact for each contact that is closed at the start.
int impacts_start(struct impact_log *log, const struct state *s, struct error *e);

// Takes every live link through the step from `now` to `next`: impacts, energies and peaks.
int impacts_step(struct impact_log *log, const struct state *now, const struct state *next,
                 struct error *e);

// Time from the start of the step of length h at which link k opens, and in *rate the velocity of
// its penetration then [L/T].
double impacts_opening(const struct model *m, const struct state *now, const struct state *next,
                       double h, int k, double *rate);

// Adds to the totals of link k and, if one is under way, to its impact.
void impacts_add(const struct impact_log *log, int k, const struct impact_share *share);

// Takes the forces of `s`, which have jumped, into the peaks of the impacts under way.
void impacts_jump(struct impact_log *log, const struct state *s);

// Opens or ends the impact of link k, which has just closed or opened at the instant of `s`.
int impacts_toggle(struct impact_log *log, const struct state *s, int k, struct error *e);

// Ends the impacts of rigid contacts that rested and have parted at the instant of `s`.
void impacts_part(struct impact_log *log, const struct state *s);

// Records the rigid contacts that have met at the instant of `s`: impacts that are over at once, or
// have come to rest, or end a rest. `meeting` is (n_contact).
int impacts_meet(struct impact_log *log, const struct state *s, const struct meeting *meeting,
                 struct error *e);

// Ends the impacts still under way at the end of a run, sets the forces of rigid contacts to NAN,
// and sorts all impacts by time.
void impacts_finish(struct impact_log *log, const struct state *s);

// The largest values over all computed steps, and their times; and the drifts that remain.

// What results hold while they grow, but for the list of impacts.
extern const struct fields results_fields;

// Room for the results of a model; false: no memory.
bool peaks_alloc(struct results *r, const struct model *m, struct arena *a);

// Gives links their largest penetrations, at the end of a run.
void peaks_finish(struct results *r, const struct model *m);

// In residual_drift.c: the size of the residual drift [L] of each storey (n_dof): where its law has
// no shear when the storey unloads from state `s`; 0 of elastic ones. NAN: the law does not unload
// to zero. The arena is for scratch. False: no memory.
bool residual_drifts(const struct model *m, const struct state *s, double *out, struct arena *a);

// The same for bilateral links: what they have lost, and their residual deformations.
void residual_links(const struct model *m, const struct state *s, struct link_peak *link);

// Takes state `s` into the envelopes of floors and contacts.
void peaks_update(struct results *r, const struct model *m, const struct state *s);

// Takes storey deformations and shears of buildings with a foundation from state `s`.
void peaks_founded(struct results *r, const struct model *m, const struct state *s);

// Takes the forces in struck columns of state `s`.
void peaks_columns(struct results *r, const struct model *m, const struct state *s);

// Takes the drift rates of state `s`.
void peaks_drift_rates(struct results *r, const struct model *m, const struct state *s);

// Raises a peak, and its time, to x where that is greater; lowers it where that is less.
static inline void peak_larger(double x, double time, double *peak, double *peak_time) {
    *peak_time = x > *peak ? time : *peak_time;
    *peak = x > *peak ? x : *peak;
}

static inline void peak_smaller(double x, double time, double *peak, double *peak_time) {
    *peak_time = x < *peak ? time : *peak_time;
    *peak = x < *peak ? x : *peak;
}

// The value that peaks take of a force or penetration x of link k: its size, if the link is
// bilateral.
static inline double peaks_size(const struct model *m, int k, double x) {
    return k >= m->n_contact ? fabs(x) : x;
}

// Raise the largest penetration and the largest force of link k.
static inline void peaks_penetration(struct results *r, int k, double delta, double time) {
    peak_larger(delta, time, &r->deepest[k], &r->deepest_time[k]);
}

static inline void peaks_force(struct results *r, int k, double force, double time) {
    peak_larger(force, time, &r->link[k].force, &r->link[k].force_time);
}

// Raises both to those of live link k in state `s`.
static inline void peaks_link(struct results *r, const struct model *m, const struct state *s,
                              int k) {
    peaks_force(r, k, peaks_size(m, k, s->link[k].force), s->time);
    peaks_penetration(r, k, peaks_size(m, k, s->delta[k]), s->time);
}

// Take a value of a force in a struck column, and of force i of those that follow from drifts.
static inline void peaks_column(struct column_peak *p, double x, double time) {
    peak_larger(x, time, &p->max, &p->max_time);
    peak_smaller(x, time, &p->min, &p->min_time);
}

static inline void peaks_member(struct results *r, int i, double x, double time) {
    if (x > r->force_max[i]) {  // seldom, so that branches are faster than choices
        peak_larger(x, time, &r->force_max[i], &r->force_max_time[i]);
    }
    if (x < r->force_min[i]) {
        peak_smaller(x, time, &r->force_min[i], &r->force_min_time[i]);
    }
}

// Takes the deformation or the shear of storey i with a foundation: PEAK_DRIFT or PEAK_SHEAR.
static inline void peaks_storey(struct results *r, enum peak q, int i, double x, double time) {
    const int k = q == PEAK_SHEAR;
    peak_larger(fabs(x), time, &r->founded_peak[k][i], &r->founded_time[k][i]);
}

// What storeys and hinges that yield have gone through: energies, ductilities, and how far they
// have deteriorated.
//
// The work on a storey without parts beside it is in the account of energy, and its largest drift
// is among the peaks. Only laws of which this does not say enough are noted step by step: those in
// buildings with parts, whose works follow from the trapezoidal rule, and those of storeys whose
// yields differ in both directions.

// A law that is noted: of a storey, or of a hinge.
struct yielding_law {
    const struct storey *storey;
    const struct building *building;
    int history;       // offset in the state's storey history
    int dof;           // of the floor above the storey; of a hinge: -1,
    int hinge;         // and its number among those of all buildings
    double stiffness;  // [F L] initial, of a hinge
};

struct yielding {
    const struct model *model;
    int n;                           // laws
    const struct yielding_law *law;  // (n)
    double *deformation, *force;     // (n) at the last state
    double *work_2x;                 // (n) twice the work so far
    double *most[2];                 // (n) largest deformation to the right, and to the left
    double *stored;                  // (n) [F L] at the start
};
extern const struct fields yielding_fields;

// Do the yields of a storey differ in both directions?
bool yielding_differs(const struct storey *s);

// Finds the laws of the model; its fields are allocated with those of force_peaks. False: no
// memory.
bool yielding_alloc(struct yielding *y, const struct model *m, struct arena *a);

// Takes the state at t = 0, and a state to which a step has led.
void yielding_start(struct yielding *y, const struct state *s);
void yielding_note(struct yielding *y, const struct state *s);

// Sets what the results say of storeys and hinges in the last state, when their peaks are final.
void yielding_finish(struct yielding *y, const struct energy_account *energy, const struct state *s,
                     struct results *r);

// The largest and smallest of the forces that follow from drifts and departures of hinges
// (model/forces.h), over all computed steps.
//
// Such actions of FORCES_BATCH states are collected. An action stays near the straight line from
// the first to the last of them: by its bow at most. So a force with the row p stays between its
// values at the first and the last state, widened by sum(|p| bow). Only forces that may so exceed
// their extremes so far are computed, state by state. They are few.

struct force_peaks {
    const struct model *model;
    struct results *results;   // borrowed
    struct yielding yielding;  // which is noted at the same states
    int n;                     // states in the batch
    double time[FORCES_BATCH];
    int n_action;    // of a state: model.chain.n drifts, then departures
    double *action;  // (FORCES_BATCH, n_action)
    double *bow;     // (n_action) scratch
    double *turned;  // (n_action, FORCES_BATCH) scratch: those of a building, one by one
};
extern const struct fields force_peaks_fields;

// Room for the forces of the results' model; false: no memory.
bool force_peaks_alloc(struct force_peaks *p, const struct model *m, struct results *r,
                       struct arena *a);

// Are there forces or laws that must be noted?
static inline bool force_peaks_due(const struct force_peaks *p) {
    return p->model->n_force > 0 || p->yielding.n > 0;
}

// Takes the states of the batch into the extremes, and empties it.
void force_peaks_flush(struct force_peaks *p);

// Takes a state: its displacements, and departures of hinges.
static inline void force_peaks_note(struct force_peaks *p, const struct state *s) {
    const struct model *m = p->model;
    const struct chain *c = &m->chain;
    if (p->yielding.n > 0) {
        yielding_note(&p->yielding, s);
    }
    if (m->n_force == 0) {
        return;
    }
    double *action = p->action + (ptrdiff_t)p->n * p->n_action;
    for (int i = 0; i < c->n; i++) {
        action[i] = s->u[i] - c->joint[i] * s->u[i - 1];
    }
    state_struck(s, m, action);
    for (int k = 0; m->n_hinge > 0 && k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        memcpy(action + c->n + g->first_hinge, s->storey_history + g->departure,
               (size_t)g->n_hinge * sizeof *action);
    }
    p->time[p->n++] = s->time;
    if (p->n == FORCES_BATCH) {
        force_peaks_flush(p);
    }
}

#endif
