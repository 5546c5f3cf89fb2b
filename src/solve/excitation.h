// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions and loads at an instant.
#ifndef JOSTLE_EXCITATION_H
#define JOSTLE_EXCITATION_H

#include "solve/forcing.h"
#include "solve/state.h"

// Sets the ground's acceleration (and, where links need them, velocity and displacement) and the
// external forces -m a_ground + p of `s` to time t.
void excitation_at(struct state *s, const struct model *m, double t);

// The forces on the floors only, with the ground's accelerations as they are in `s`.
void excitation_floors(struct state *s, const struct model *m, double t);

// The same from the pieces of the forcing, no later than its next corner: there the limit from the
// left before forcing_turn, that from the right after it.
void excitation_of_pieces(struct state *s, const struct forcing *f, double t);

// Ends of fixed steps, and where one ground moves all the ground's accelerations then, computed for
// many steps at a time.
enum { EXCITATION_AHEAD = 128 };
struct excitation_ahead {
    long from;                      // step of the first; before anything is known -EXCITATION_AHEAD
    long sought;                    // that asked for last, from there
    double time[EXCITATION_AHEAD];  // [T]
    double ground[EXCITATION_AHEAD];  // [L/T^2]
};

// Sees to it that what is known begins with step n or before, and goes as far as n or beyond.
void excitation_foresee(struct excitation_ahead *x, const struct model *m, long n);

// The motion of the grounds only, at any t; looked up where t is the end of the step sought last.
void excitation_grounds_known(const struct excitation_ahead *x, struct state *s,
                              const struct model *m, double t);

#endif
