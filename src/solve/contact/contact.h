// SPDX-License-Identifier: GPL-3.0-or-later
// The links in a step: which act (contact_step.c), and their forces at its end, with the buildings
// linear about their trial state.
#ifndef JOSTLE_CONTACT_H
#define JOSTLE_CONTACT_H

#include "solve/work.h"

// Makes the links that are closed in `now` live in `next`, with a guess of their forces; the others
// are open.
void contact_begin(struct work *w, const struct state *now, struct state *next);

// Makes those links live that close on the way to the penetrations of `next`; returns how many.
int contact_search(struct work *w, const struct state *now, struct state *next);

// The same for link k; returns whether it closes.
bool contact_close(struct work *w, const struct state *now, struct state *next, int k);

// On entry w->correction solves the buildings' equations under the link forces next->force; on
// return both are changed so that the force of every live link also obeys its law. `now` is the
// committed state. STATUS_RETRY: not solved to the model's tolerance.
int contact_solve(struct work *w, const struct state *now, struct state *next);

// Brings the histories of closed links to the end of a step that is solved.
void contact_finish(const struct work *w, struct state *next);

#endif
