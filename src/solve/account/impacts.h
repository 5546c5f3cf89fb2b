// SPDX-License-Identifier: GPL-3.0-or-later
// The account of impacts, and of the totals of links, from step to step.
#ifndef JOSTLE_IMPACTS_H
#define JOSTLE_IMPACTS_H

#include "solve/account/energy.h"

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

// Ends the impacts of rigid contacts that rested and have parted at the instant of `s`.
void impacts_part(struct impact_log *log, struct results *r, const struct model *m,
                  const struct state *s);

// Takes account of the rigid contacts that have met at the instant of `s`: impacts that are over at
// once, or have come to rest, or end a rest. `meeting` is (n_contact).
int impacts_meet(struct impact_log *log, struct results *r, const struct model *m,
                 const struct state *s, const struct meeting *meeting, struct error *e);

// Ends the impacts still under way, blots out what rigid contacts say of forces, and puts all in
// order of time.
void impacts_finish(struct impact_log *log, struct results *r, const struct model *m,
                    const struct state *s);

#endif
