// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions and loads: at an instant, at the ends of fixed steps, and between their corners. A
// corner is a sample of a record or a load history, or the start or the end of any signal: there
// the forcing has a kink or a jump, and between two corners it is smooth.
#ifndef JOSTLE_FORCING_H
#define JOSTLE_FORCING_H

#include <float.h>

#include "solve/state.h"

// Instants that differ by less than this share of them are one: steps, corners and rows differ by
// rounding.
static const double FORCING_SAME_TIME = 8.0 * DBL_EPSILON;

// A straight line: value + slope (t - start).
struct sloping {
    double start, value, slope;  // [T] [.] [./T]
};

static inline double forcing_on_line(const struct sloping *l, double t) {
    return l->value + l->slope * (t - l->start);
}

// A signal between two of its corners.
struct piece {
    const struct signal *sine;  // borrowed; NULL: it is a line
    double end;                 // [T] its next corner; may be infinite
    struct sloping line;        // 0 of a sine
};

// In storage that fields_alloc makes, with the model set, all pieces end at t = 0, where
// forcing_turn is due for the first time.
struct forcing {
    const struct model *model;  // borrowed
    struct piece *ground;       // those of ground 0, then 1, ...
    struct piece *load;         // (model.n_load)
    struct sloping *lines;      // (model.n_ground) the lines of a ground's signals together
    bool sines;                 // does any ground move in one?
    double corner;              // [T] the next corner of all; may be infinite
};
extern const struct fields forcing_fields;

// What the forcing is at an instant. Arrays (n_ground).
struct forcing_values {
    double *a;      // [L/T^2]
    double *v, *u;  // [L/T] [L] only where there is more than one ground
};

// Replaces the pieces that end at time t by those that begin there. True if a signal jumps. At the
// end of the analysis the pieces stay: what is after it does not count.
bool forcing_turn(struct forcing *f, double t);

// The lines of ground k at time t, not after the next corner.
static inline double forcing_lines(const struct forcing *f, int k, double t) {
    return forcing_on_line(&f->lines[k], t);
}

// The ground's motion then: lines and all else.
void forcing_ground(const struct forcing *f, double t, struct forcing_values *out);

// Load number k at time t, not after the next corner [F].
double forcing_load(const struct forcing *f, int k, double t);

// Sets the ground's acceleration (and, where links need them, velocity and displacement) and the
// external forces -m a_ground + p of `s` to time t.
void forcing_at(struct state *s, const struct model *m, double t);

// The ground's accelerations under the floors, as they are in `s`, and the external forces. `f` is
// NULL where loads do not come from pieces.
void forcing_floors(struct state *s, const struct model *m, const struct forcing *f, double t);

// forcing_at from the pieces of the forcing, for t up to its next corner. At the corner it is
// the limit from the left before forcing_turn, and that from the right after.
void forcing_of_pieces(struct state *s, const struct forcing *f, double t);

// The ends of fixed steps, and if one ground moves all floors its accelerations then, computed many
// steps at a time.
enum { FORCING_AHEAD = 128 };
struct forcing_ahead {
    long from;                     // the first of these steps; -FORCING_AHEAD: none is known
    long sought;                   // the step that was asked for last, counted from `from`
    double time[FORCING_AHEAD];    // [T]
    double ground[FORCING_AHEAD];  // [L/T^2]
};

// Computes ahead, unless that has been done, so that step n is among the steps that are known.
void forcing_foresee(struct forcing_ahead *x, const struct model *m, long n);

// forcing_at, where t is often the end of the step sought last: its accelerations are looked up. If
// one ground moves all floors, these are all that it sets.
void forcing_known(const struct forcing_ahead *x, struct state *s, const struct model *m, double t);

#endif
