// SPDX-License-Identifier: GPL-3.0-or-later
// What the step controls of both adaptive methods share: equal steps to the next corner, whether
// the run will end in a reasonable time, and what is said where it will not.
#ifndef JOSTLE_PACE_H
#define JOSTLE_PACE_H

#include "jostle/model.h"

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

#endif
