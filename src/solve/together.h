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
    int left[TOGETHER_MAX], right[TOGETHER_MAX];  // which of them are the next in its row; -1: none
};

// What a contact gives for it.
struct passage {
    bool joined;      // its bodies move on together
    double push;      // >= 0, force or impulse
    double approach;  // how fast its bodies approached
    double lost;      // of velocities: kinetic energy
};

// Finds the neighbours of the contacts of `t`; false if a floor has two on one side.
bool together_line_up(struct together *t, const struct model *m);

// The contacts of the row that begins with contact i of `t`, from left to right, into `contact`;
// returns how many they are, 0 if none begins there.
int together_row(const struct together *t, int i, int *contact);

// Changes the motions y of n bodies in a row, with masses (INFINITY: a wall), so that none falls
// behind the one on its right, as together_move does; `p` (n - 1) is what passes between them.
void together_push(int n, const double *mass, double *y, struct passage *p);

typedef void together_note(void *context, int k, const struct passage *p);

// Finds the contacts at rest. False if there are too many of them, or if a floor has two on one
// side, so that they are no rows.
bool together_find(const struct state *s, const struct model *m, struct together *t);

// Changes `x` (n_dof), velocities or accelerations, by pushes of these contacts, so that none of
// their bodies approach each other and each contact that pushes holds its bodies together. `ground`
// is what the grounds do.
void together_move(const struct together *t, const struct model *m, double *x, const double *ground,
                   together_note *note, void *context);

#endif
