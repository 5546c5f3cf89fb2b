// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/pace.h"

#include <math.h>

// The pace is checked once in so many steps, but for the first of them: in a start from rest, steps
// may be far shorter than later on.
enum { PACE_STEPS = 20000 };

// The equal parts may be this much longer than the error control asks for: less than 1 / SAFETY of
// adaptive_newmark.c, so that a step rejected is never tried again, and less than what makes SAFETY
// of dp_step.c of the way to a corner one part again.
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
    return p->tried > PACE_STEPS && way * ADAPTIVE_STEPS_MAX < PACE_STEPS * m->duration;
}

void pace_next(double time, double goal, double trial, double longest, double *h, double *end) {
    const double rest = goal - time;
    *h = rest;
    *end = goal;
    if (rest <= (1.0 + STRETCH) * trial && rest <= longest) {
        return;
    }
    const double parts = ceil(fmax(rest / trial - STRETCH, rest / longest - ROUNDING));
    if (parts > 1.0) {
        *h = rest / parts;
        *end = time + *h;
    }
}

bool pace_can_shorten(const struct model *m, double time, double h) {
    return h > m->control.shortest && time + h / 2.0 > time;
}

int pace_too_slow(const struct model *m, double time, double h, const struct pace_cause *cause,
                  struct error *e) {
    const char *unit = m->deck->units.time_name;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s the steps are %.2g %s because of %s, which makes more than "
                     "%.0e of them; use a larger -tolerance, %s",
                     time, unit, h, unit, cause->name, (double)ADAPTIVE_STEPS_MAX, cause->remedy);
}

int pace_too_long(const struct model *m, double time, double h, const struct pace_cause *cause,
                  struct error *e) {
    const char *unit = m->deck->units.time_name;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s a step of %.3g %s is still too long for %s; use a larger "
                     "-tolerance, a smaller -min%s or step fixed DT",
                     time, unit, h, unit, cause->name, cause->remedy);
}
