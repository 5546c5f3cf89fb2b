// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibrium at an instant, and rigid contacts at rest, at an instant and in a step.
#ifndef JOSTLE_REST_H
#define JOSTLE_REST_H

#include "solve/state.h"

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

#endif
