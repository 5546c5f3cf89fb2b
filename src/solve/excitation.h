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

// excitation_at from the pieces of the forcing, for t up to its next corner. At the corner it is
// the limit from the left before forcing_turn, and that from the right after.
void excitation_of_pieces(struct state *s, const struct forcing *f, double t);

// The ends of fixed steps, and if one ground moves all floors its accelerations then, computed many
// steps at a time.
enum { EXCITATION_AHEAD = 128 };
struct excitation_ahead {
    long from;                      // step of the first; before anything is known -EXCITATION_AHEAD
    long sought;                    // that asked for last, from there
    double time[EXCITATION_AHEAD];  // [T]
    double ground[EXCITATION_AHEAD];  // [L/T^2]
};

// Computes ahead, unless that has been done, so that step n is among the steps known.
void excitation_foresee(struct excitation_ahead *x, const struct model *m, long n);

// The motion of the grounds only, at any t; looked up where t is the end of the step sought last.
void excitation_grounds_known(const struct excitation_ahead *x, struct state *s,
                              const struct model *m, double t);

#endif
