// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid contacts at rest, at an instant and in a step.
#ifndef JOSTLE_REST_H
#define JOSTLE_REST_H

#include "solve/state.h"

// Finds the forces f >= 0 under which the bodies of rigid contacts at rest do not approach each
// other, and adds what they do to the accelerations of `s`, which must be those under all other
// forces and s->force. Contacts whose bodies part under f = 0 open.
void rest_forces(struct state *s, const struct model *m);

// Motions `x` (n_dof), velocities or accelerations, of both bodies that differ by no more are the
// same.
double rest_rounding(const struct link *l, const double *x);

// The velocity to which rigid contact k, at rest in `now`, is brought by a step of size h.
double rest_velocity(const struct state *now, const struct model *m, double h, int k);

// The contacts at rest.
enum { REST_MAX = 256 };
struct rest_contacts {
    int n;
    int contact[REST_MAX];
};

// What passes between the bodies of a contact.
struct passage {
    double push;      // >= 0, force or impulse
    double approach;  // how fast its bodies approached
    double lost;      // of velocities: kinetic energy
};

typedef void rest_note(void *context, int k, const struct passage *p);

// Finds the contacts at rest. False if there are too many of them, or if they are not rows of
// bodies: a floor has two on one side, or an end is not one floor.
bool rest_find(const struct state *s, const struct model *m, struct rest_contacts *t);

// Changes `x` (n_dof), velocities or accelerations, by pushes of these contacts, so that none of
// their bodies approach each other and each contact that pushes holds its bodies together. `ground`
// is what the grounds do.
void rest_pool(const struct rest_contacts *t, const struct model *m, double *x,
               const double *ground, rest_note *note, void *context);

#endif
