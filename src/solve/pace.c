// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/pace.h"

#include <math.h>

// The pace is checked once in so many steps.
enum { PACE_STEPS = 20000 };

// The equal parts may be this much longer than the error control asks for: less than 1 / SAFETY of
// step_length.c, so that a step rejected is never tried again, and less than what makes SAFETY of
// dp_step.c of the way to a corner one part again.
static const double STRETCH = 0.1;

// Rounding of rest / longest.
static const double ROUNDING = 1e-9;

bool pace_is_slow(struct pace *p, const struct model *m, double time, double *step) {
    if (++p->tried % PACE_STEPS != 0) {
        return false;
    }
    double way = time - p->time;
    p->time = time;
    *step = way / PACE_STEPS;
    return way * ADAPTIVE_STEPS_MAX < PACE_STEPS * m->duration;
}

double pace_parts(double rest, double trial, double longest) {
    if (rest <= (1.0 + STRETCH) * trial && rest <= longest) {
        return 1.0;
    }
    return ceil(fmax(rest / trial - STRETCH, rest / longest - ROUNDING));
}
