// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/pace.h"

// Looked at once in so many steps.
enum { PACE_STEPS = 20000 };

bool pace_is_slow(struct pace *p, const struct model *m, double time, double *step) {
    if (++p->tried % PACE_STEPS != 0) {
        return false;
    }
    double way = time - p->time;
    p->time = time;
    *step = way / PACE_STEPS;
    return way * ADAPTIVE_STEPS_MAX < PACE_STEPS * m->duration;
}
