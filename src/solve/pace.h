// SPDX-License-Identifier: GPL-3.0-or-later
// Will a run of adaptive steps end in a reasonable time?
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

#endif
