// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a step is short enough for the contacts that act in it.
#ifndef JOSTLE_RESOLVE_H
#define JOSTLE_RESOLVE_H

#include "solve/contact/sweep_step.h"

// resolve_suffices in full, for where its short cut does not apply.
bool resolve_judge(struct work *w, const struct state *now, const struct state *next,
                   struct link_scratch *p);

// A contact of stiffness k lasts pi sqrt(m / k). Over a step longer than that, average acceleration
// gives a body back more energy than it brought (up to 1.8 times its velocity), and a few such
// impacts make nonsense of a run. True if the trial step from `now` to `next` resolves the contact,
// or if there is nothing to resolve because it is pressed together and hardly moves; else
// memory.unresolved says that it needs a shorter step. In line for the usual case: the start has
// been checked, the end has its tangents, and the spring is no stiffer than one that has been
// checked.
static inline bool resolve_suffices(struct work *w, const struct state *now,
                                    const struct state *next, struct link_scratch *p) {
    double x = sweep_across(p, w->correction);
    if (p->resolved->step >= w->h && !p->stale && p->d_trial + w->b * x <= p->resolved->depth &&
        SWEEP_FITS_DASHPOT(w, p, p->dfdv)) {
        p->resolved->step = w->h;
        return true;
    }
    return resolve_judge(w, now, next, p);
}

// A contact this slow is at rest, whatever the step does to it: its energy is 1e-10 of the floors'.
// Otherwise a body that bounces to rest would need ever shorter steps.
bool resolve_negligible(const struct work *w, const struct state *now, double velocity);

#endif
