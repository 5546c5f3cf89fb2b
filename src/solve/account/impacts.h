// SPDX-License-Identifier: GPL-3.0-or-later
// The account of impacts, and of the totals of links, from step to step.
#ifndef JOSTLE_IMPACTS_H
#define JOSTLE_IMPACTS_H

#include "solve/account/energy.h"

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

#endif
