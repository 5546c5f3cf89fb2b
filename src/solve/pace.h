// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths of adaptive steps, and the sizes that their errors are relative to.
#ifndef JOSTLE_PACE_H
#define JOSTLE_PACE_H

#include <float.h>

#include "jostle/analysis.h"
#include "jostle/model.h"
#include "solve/fields.h"

// What the step controls of both adaptive methods share: equal steps to the next corner, whether
// the run will end in a reasonable time, and what is said where it will not.

struct pace {
    long tried;   // steps, rejected ones included
    double time;  // [T] when the pace was last looked at
};

// Counts a step that is tried at `time`. True if steps have become so short that the run would take
// more than ADAPTIVE_STEPS_MAX of them; *step is then their mean length [T].
bool pace_is_slow(struct pace *p, const struct model *m, double time, double *step);

// The next one of the equal steps from `time` to `goal`, its length *h and its end *end [T]: they
// may be a little longer than `trial`, but not longer than `longest`.
void pace_next(double time, double goal, double trial, double longest, double *h, double *end);

// May a step of h from `time` on be tried again with a shorter one?
bool pace_can_shorten(const struct model *m, double time, double h);

// What keeps steps short, and the options that help, for the errors STATUS_FAILED that are set:
// steps of `h` are too many, or still too long.
struct pace_cause {
    const char *name, *remedy;
};
int pace_too_slow(const struct model *m, double time, double h, const struct pace_cause *cause,
                  struct error *e);
int pace_too_long(const struct model *m, double time, double h, const struct pace_cause *cause,
                  struct error *e);

// The scales of errors in adaptive steps: the largest displacement and velocity of any floor of the
// building so far.

// Of a length: what means nothing.
static const double SCALE_ROUNDING = 64.0 * DBL_EPSILON;

struct scales {
    double *over_u, *over_v;  // [1/L] [T/L] (n_dof) 1 over the sizes; 0: nothing moves
    double most_u, most_v;    // [L] [L/T] of any building so far
    double most_a;            // [L/T^2] of accelerations
    int noisy;  // a building whose displacements are rounded by more than its accelerations allow;
                // -1
    double *square, *memory;  // [1/T^2] [T] (n_building) NULL: accelerations do not matter
};
extern const struct fields scale_fields;  // but for `square` and `memory`, which stay

// Starts with sizes that motions will at least reach: those of the slowest mode under a hundredth
// of the excitation. Without them a start from rest, under forces that have a kink there, would
// take steps without end.
void scale_expect(struct scales *s, const struct model *m);

// Updates the scales from the peaks so far.
void scale_update(struct scales *s, const struct model *m, const struct results *r);

#endif
