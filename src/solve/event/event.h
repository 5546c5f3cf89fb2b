// SPDX-License-Identifier: GPL-3.0-or-later
// What happens at an instant.
#ifndef JOSTLE_EVENT_H
#define JOSTLE_EVENT_H

#include "solve/state.h"

// Equilibrium at an instant, and rigid contacts at rest, at an instant and in a step.

// The state at t = 0: initial displacements and velocities, links closed where delta > 0 or about
// to close (delta = 0, rate > 0), rigid contacts where forces press them together (delta >= 0, rate
// = 0), accelerations from equilibrium. Storeys have come there from zero drift without turning;
// the histories of links are left to state_commit_links.
void rest_start(struct state *s, const struct model *m);

// Accelerations that bring the forces of `s` into equilibrium, at the start of a run and where
// forces jump. The forces f >= 0 of rigid contacts at rest keep their bodies from approaching each
// other; contacts whose bodies part under f = 0 open.
void rest_equilibrium(struct state *s, const struct model *m);

// Motions `x` (n_dof), velocities or accelerations, of both bodies that differ by no more are the
// same.
double rest_rounding(const struct link *l, const double *x);

// The velocity to which rigid contact k, at rest in `now`, is brought by a step of size h.
double rest_velocity(const struct state *now, const struct model *m, double h, int k);

// What passes between the bodies of a contact.
struct passage {
    bool pooled;      // they have got one motion
    double push;      // >= 0, force or impulse
    double approach;  // how fast its bodies approached
    double lost;      // of velocities: kinetic energy
};

// The contacts at rest.
enum { REST_MAX = 256 };
struct rest_contacts {
    int n;
    int contact[REST_MAX];
    struct passage passage[REST_MAX];  // set by rest_pool
};

// Finds the contacts at rest. False if there are too many of them, or if they are not rows of
// bodies: a floor has two on one side, or an end is not one floor.
bool rest_find(const struct state *s, const struct model *m, struct rest_contacts *t);

// Changes `x` (n_dof), velocities or accelerations, by pushes of these contacts, so that none of
// their bodies approach each other and each contact that pushes holds its bodies together. `ground`
// is what the grounds do.
void rest_pool(struct rest_contacts *t, const struct model *m, double *x, const double *ground);

// Impacts of laws without a force, at the instant at which two bodies meet.

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
