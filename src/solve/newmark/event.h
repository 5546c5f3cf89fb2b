// SPDX-License-Identifier: GPL-3.0-or-later
// Instants within a step at which forces or velocities jump: closures and openings of contact laws
// whose force jumps there, and closures of rigid ones. Passing over a jump is an error of the first
// order in the step, so such steps are split at the jump. Adaptive steps are split wherever a
// contact closes or opens, as forces may begin there with an infinite slope.
#ifndef JOSTLE_EVENT_H
#define JOSTLE_EVENT_H

#include "solve/work.h"

struct event {
    int link;     // -1: none
    double time;  // [T] from the start of the step
};

// At most so many events of one contact in one step of the deck: a contact whose force jumps is
// then left to the step, a rigid one is settled without rebound, and if that does not help, the run
// is ended.
enum { EVENTS_JUMP_MAX = 50, EVENTS_RIGID_MAX = 500, EVENTS_ENDLESS = 100000 };

// The first event in the step from `now` to `next` of size h; its time is exactly 0 or h if it is
// at an end. `count` (n_contact): events of each contact in this step of the deck so far. Link
// `except` is passed over; -1: none.
struct event event_first(const struct work *w, const struct state *now, const struct state *next,
                         double h, const int *count, int except);

// Do the bodies of rigid contact k, which meet at the instant of `s`, neither approach nor press?
// Such a meeting changes nothing: it is the step that is long.
bool event_is_idle(const struct state *s, const struct model *m, int k);

// Has a rigid contact at rest opened in the step just taken while its force was large? The force,
// taken to fall evenly over the step, then pushes bodies that already part, which makes energy of
// nothing: f d / 2, which is small where the step is short. *w says which contact it is.
bool event_is_abrupt(struct work *w, const struct state *now, const struct state *next);

// Closes or opens the link of a jump of force at the instant of `s`, with the accelerations that
// follow.
void event_apply(struct state *s, const struct model *m, int link);

#endif
