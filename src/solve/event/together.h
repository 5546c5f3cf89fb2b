// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of bodies whose rigid contacts are at rest, at an instant: how they move on.
#ifndef JOSTLE_TOGETHER_H
#define JOSTLE_TOGETHER_H

#include "solve/state.h"

enum { TOGETHER_MAX = 256 };

// The contacts at rest.
struct together {
    int n;
    int contact[TOGETHER_MAX];
};

// What a contact gives for it.
struct passage {
    double push;      // >= 0, force or impulse
    double approach;  // how fast its bodies approached
    double lost;      // of velocities: kinetic energy
};

typedef void together_note(void *context, int k, const struct passage *p);

// Finds the contacts at rest. False if there are too many of them, or if they are not rows of
// bodies: a floor has two on one side, or an end is not one floor.
bool together_find(const struct state *s, const struct model *m, struct together *t);

// Changes `x` (n_dof), velocities or accelerations, by pushes of these contacts, so that none of
// their bodies approach each other and each contact that pushes holds its bodies together. `ground`
// is what the grounds do.
void together_move(const struct together *t, const struct model *m, double *x, const double *ground,
                   together_note *note, void *context);

#endif
