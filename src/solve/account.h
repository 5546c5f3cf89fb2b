// SPDX-License-Identifier: GPL-3.0-or-later
// What is kept of every computed step: energies, peaks and impacts.
#ifndef JOSTLE_ACCOUNT_H
#define JOSTLE_ACCOUNT_H

#include <math.h>

#include "core/lanes.h"
#include "solve/chain.h"
#include "solve/impulse.h"

// Works since t = 0 [F L], each the sum over steps of a mean force times a displacement.
struct energy_account {
    double initial;  // kinetic, strain and contact energy at t = 0
    // Twice the work of external and damping forces: floor i of the chain adds to element i %
    // LANES_WIDTH, and in a step the lower floor first.
    double input_2x[LANES_WIDTH], damping_2x[LANES_WIDTH];
    double input, damping;  // beyond that: of links on the grounds, of adaptive steps
    double contact;
    double *storey_2x;    // (n_dof) twice the work on storeys, where some are not elastic
    double storey;        // work on storeys that are not elastic, beyond that
    double stored_start;  // their recoverable energy at t = 0
};

// Room for the account of a model; false: no memory.
bool energy_alloc(struct energy_account *a, const struct model *m, struct arena *arena);

// Energies of the start state.
void energy_start(struct energy_account *a, const struct model *m, const struct state *s);

// Adds what closed links hold at the start state, which is both initial and work done on them, to
// the account and to each link's own in `link` (n_link). Errors: STATUS_SYSTEM (no memory).
int energy_start_links(struct energy_account *a, const struct model *m, const struct state *s,
                       struct link_peak *link, struct error *e);

// Adds what floors and storeys did in the step from `now` to `next`.
void energy_step(struct energy_account *a, const struct model *m, const struct state *now,
                 const struct state *next);

// Adds what the ground and the loads did to the floors in the step.
void energy_input(struct energy_account *a, const struct model *m, const struct state *now,
                  const struct state *next);

// Adds what rigid contacts that met at the instant of `s` have lost. `meeting` is (n_contact).
void energy_meet(struct energy_account *a, const struct model *m, const struct state *s,
                 const struct meeting *meeting);

// What the account needs of a state: sums over all floors.
struct energy_sums {
    double kinetic;               // [F L]
    double elastic, other;        // [F L] stored in elastic storeys, and in others
    double storey;                // [F L] work so far on those
    double input_2x, damping_2x;  // [F L] twice the work of external and damping forces so far
};

// The account with the sums of a state, into energy (ENERGY_COUNT).
void energy_close(const struct energy_account *a, const struct energy_sums *sums, double *energy);

// The account at state `s` into energy (ENERGY_COUNT).
void energy_balance(const struct energy_account *a, const struct model *m, const struct state *s,
                    double *energy);

// Room for the results of a model; false: no memory.
bool peaks_alloc(struct results *r, const struct model *m, struct arena *a);

// Takes state `s` into the envelopes of floors and contacts.
void peaks_update(struct results *r, const struct model *m, const struct state *s);

// The same in parts: the peaks of n floors from `first` on,
void peaks_floors(struct results *r, int first, int n, const struct state *s);

// those of all floors;
void peaks_all_floors(struct results *r, const struct model *m, const struct state *s);

// contacts and other links;
void peaks_links(struct results *r, const struct model *m, const struct state *s);

// where |x| is greater than the peak, the peak and its time;
static inline void peak_raise(double x, double time, double *peak, double *peak_time) {
    double size = fabs(x);
    *peak_time = size > *peak ? time : *peak_time;
    *peak = size > *peak ? size : *peak;
}

// the largest velocity of all floors, from the peaks of n of them from `first` on;
void peaks_speed(struct results *r, int first, int n);

// the penetration of contact k, if it is larger than ever before;
static inline void peaks_penetration(struct results *r, int k, double delta, double time) {
    if (delta > r->deepest[k]) {
        r->deepest[k] = r->link[k].penetration = delta;
        r->link[k].penetration_time = time;
    }
}

// force and penetration of live link k;
static inline void peaks_link(struct results *r, const struct model *m, const struct state *s,
                              int k) {
    struct link_peak *p = &r->link[k];
    bool both = k >= m->n_contact;
    double force = both ? fabs(s->link[k].force) : s->link[k].force;
    if (force > p->force) {
        p->force = force;
        p->force_time = s->time;
    }
    if (!both) {
        peaks_penetration(r, k, s->delta[k], s->time);
    } else if (fabs(s->delta[k]) > p->penetration) {
        p->penetration = fabs(s->delta[k]);
        p->penetration_time = s->time;
    }
}

// the penetrations of n contacts.
void peaks_penetrations(struct results *r, int n, const struct state *s);

// The impacts that are under way. Arrays (n_contact).
struct impact_log {
    long *open;  // index into results.impact of the impact under way; -1: none
};

// What one step brings to a link.
struct impact_share {
    double impulse, work;       // [F T] [F L]
    double force, penetration;  // [F] [L] largest
    long steps;                 // 1 if it counts as a step in contact
};

// Adds to the totals of link k and, if one is under way, to its impact.
void impacts_add(struct impact_log *log, struct results *r, const struct model *m, int k,
                 const struct impact_share *share);

bool impacts_alloc(struct impact_log *log, const struct model *m, struct arena *a);

// Opens an impact for each contact that is closed at the start.
int impacts_start(struct impact_log *log, struct results *r, const struct model *m,
                  const struct state *s, struct error *e);

// Carries every live link through the step from `now` to `next`: impacts, energies and peaks.
// STATUS_SYSTEM: no memory.
int impacts_step(struct impact_log *log, struct energy_account *a, struct results *r,
                 const struct model *m, const struct state *now, const struct state *next,
                 struct error *e);

// Takes account of a link that has just been closed or opened at the instant of state `s`.
int impacts_toggle(struct impact_log *log, struct results *r, const struct model *m,
                   const struct state *s, int k, struct error *e);

// Takes account of the rigid contacts that have met at the instant of `s`: impacts that are over at
// once, or have come to rest, or end a rest. `meeting` is (n_contact).
int impacts_meet(struct impact_log *log, struct results *r, const struct model *m,
                 const struct state *s, const struct meeting *meeting, struct error *e);

// Ends the impacts still under way, blots out what rigid contacts say of forces, and puts all in
// order of time.
void impacts_finish(struct impact_log *log, struct results *r, const struct model *m,
                    const struct state *s);

#endif
