// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts of laws without a force, at the instant at which two bodies meet.
#ifndef JOSTLE_IMPULSE_H
#define JOSTLE_IMPULSE_H

#include "solve/state.h"

// What one contact did at this instant.
struct meeting {
    bool struck;
    double approach;  // [L/T] velocity of its first impact
    double impulse;   // [F T]
    double work;      // [F L] kinetic energy that was lost in it
};

enum rebound { REBOUND_BY_LAW, REBOUND_NONE };

// Bounces that are too small to follow: shorter than `time`, or with a rebound up to `velocity`.
struct least_bounce {
    double time;      // [T]
    double velocity;  // [L/T]
};

// Lets the bodies of rigid contact k meet at the instant of `s`, and those of all contacts at rest
// that this stirs up: velocities jump, then forces and accelerations follow. A contact that does
// not bounce, or by too little to follow, is at rest: closed. One at rest whose bodies part opens.
// `meeting` (n_contact) tells what happened.
void impulse_meet(struct state *s, const struct model *m, int k, enum rebound rebound,
                  const struct least_bounce *least, struct meeting *meeting);

// Takes rigid contact k as at rest without a force, although nothing presses its bodies together at
// the instant of `s`: the step that follows finds its force, or opens it.
void impulse_hold(struct state *s, const struct model *m, int k, struct meeting *meeting);

#endif
