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

#endif
