// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a step is short enough for the contacts that act in it.
#ifndef JOSTLE_RESOLVE_H
#define JOSTLE_RESOLVE_H

#include "solve/quick.h"

// The decay that the dashpot of a law may cause.
static const double RESOLVE_COARSEST_DASHPOT = 0.5;

// A contact of stiffness k lasts pi sqrt(m / k). Over a step longer than that, average acceleration
// gives a body back more energy than it brought (up to 1.8 times its velocity), and a few such
// impacts make nonsense of a run. True if the trial step from `now` to `next` resolves the contact,
// or if there is nothing to resolve because it is pressed together and hardly moves; else
// w->unresolved says that it needs a shorter step.
// `x` is what the link sees, and d where that brings it.
bool resolve_anew(struct work *w, const struct state *now, const struct state *next,
                  struct quick *p, double x, double d);

// The same, where what usually holds is enough: the start has been looked at, the end has its
// tangents, and its spring is no stiffer than has been looked at.
static inline bool resolve_suffices(struct work *w, const struct state *now,
                                    const struct state *next, struct quick *p) {
    double x = w->correction[p->end[0]] - w->correction[p->end[1]];
    double d = p->d_trial + w->b * x;
    if (p->checked >= w->h && !p->ask && d <= p->fits_to &&
        w->g * p->flexibility * p->dfdv <= RESOLVE_COARSEST_DASHPOT) {
        p->checked = w->h;
        return true;
    }
    return resolve_anew(w, now, next, p, x, d);
}

// A contact this slow is at rest, whatever the step does to it: its energy is 1e-10 of the floors'.
// Without that a body that bounces to rest would ask for ever shorter steps.
bool resolve_negligible(const struct work *w, const struct state *now, double velocity);

#endif
