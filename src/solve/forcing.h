// SPDX-License-Identifier: GPL-3.0-or-later
// Ground motions and loads between their corners. A corner is a sample of a record or a load
// history, or the start or the end of any signal: there the forcing has a kink or a jump, and
// between two corners it is smooth.
#ifndef JOSTLE_FORCING_H
#define JOSTLE_FORCING_H

#include <stdbool.h>

#include "jostle/model.h"
#include "solve/fields.h"

enum piece_shape { PIECE_LINE, PIECE_SINE };

// A signal between two of its corners.
struct piece {
    const struct signal *signal;  // borrowed
    enum piece_shape shape;
    double end;           // [T] its next corner; may be infinite
    double start;         // [T] a line: value + slope (t - start)
    double value, slope;  // [.] [./T]
};

// The lines of a ground's signals together: value + slope (t - start).
struct sloping {
    double start, value, slope;
};

struct forcing {
    const struct model *model;  // borrowed
    struct piece *ground;       // those of ground 0, then 1, ...
    struct piece *load;         // (model.n_load)
    struct sloping *lines;      // (model.n_ground)
    bool sines;                 // does any ground move in one?
    double corner;              // [T] the next corner of all; may be infinite
};
extern const struct fields forcing_fields;

// What the forcing is at an instant. Arrays (n_ground).
struct forcing_values {
    double *a;      // [L/T^2]
    double *v, *u;  // [L/T] [L] only where there is more than one ground
};

// Before all pieces, in storage that fields_alloc makes.
void forcing_init(struct forcing *f, const struct model *m);

// Room for the pieces of a model; false: no memory.
bool forcing_alloc(struct forcing *f, const struct model *m, struct arena *a);

// Replaces the pieces that end at time t by those that begin there. True if a signal jumps. At the
// end of the analysis the pieces stay: what is after it does not count.
bool forcing_turn(struct forcing *f, double t);

// The lines of ground k at time t, not after the next corner.
static inline double forcing_lines(const struct forcing *f, int k, double t) {
    const struct sloping *line = &f->lines[k];
    return line->value + line->slope * (t - line->start);
}

// The ground's motion then: lines and all else.
void forcing_ground(const struct forcing *f, double t, struct forcing_values *out);

// The velocities and displacements of the grounds at any time t.
void forcing_integrals(const struct model *m, double t, struct forcing_values *out);

// Load number k at time t, not after the next corner [F].
double forcing_load(const struct forcing *f, int k, double t);

#endif
