// SPDX-License-Identifier: GPL-3.0-or-later
// The pace of adaptive steps: how many there are to the next corner, and whether the run will end
// in a reasonable time.
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

// The number of equal steps in which to cover `rest` (a value below 1 means one step): they may be
// a little longer than `trial`, but not longer than `longest`; [T].
double pace_parts(double rest, double trial, double longest);

#endif
