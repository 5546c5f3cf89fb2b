// SPDX-License-Identifier: GPL-3.0-or-later
// Closures and openings of contact laws whose force jumps there. Passing over a jump within a step
// is an error of the first order in the step, so such steps are split at the jump.
#ifndef JOSTLE_EVENT_H
#define JOSTLE_EVENT_H

#include "solve/work.h"

struct event {
    int link;     // -1: none
    double time;  // [T] from the start of the step
};

// The first closure or opening with a jump in the step from `now` to `next` of size h; its time is
// exactly 0 or h if it is at an end.
struct event event_first(const struct model *m, const struct state *now, const struct state *next,
                         double h);

// Closes or opens the link of an event at the instant of `s`, with the accelerations that follow.
void event_apply(struct state *s, const struct model *m, int link);

#endif
