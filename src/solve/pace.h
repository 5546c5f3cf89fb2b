// SPDX-License-Identifier: GPL-3.0-or-later
// Adaptive steps: how many to the next corner, and will the run end in a reasonable time?
#ifndef JOSTLE_PACE_H
#define JOSTLE_PACE_H

#include "jostle/model.h"

struct pace {
    long tried;   // steps, rejected ones included
    double time;  // [T] when the pace was last looked at
};

// Counts a step that is tried at `time`. True if steps have become so short that the run would take
// more than ADAPTIVE_STEPS_MAX of them: *step is then how far they get [T].
bool pace_is_slow(struct pace *p, const struct model *m, double time, double *step);

// The number of equal steps, or less than 1 for one, in which to go as far as `rest`: a little
// longer ones than `trial` serve, none longer than `longest`; [T].
double pace_parts(double rest, double trial, double longest);

#endif
