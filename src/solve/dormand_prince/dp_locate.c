// SPDX-License-Identifier: GPL-3.0-or-later
// The instant found on the interpolation is only the first guess: the step is taken again to it,
// and mended by Newton's method on the state that the step itself gives, until the next correction
// would be below rounding.
#include "solve/dormand_prince/dp_locate.h"

#include <math.h>

#include "solve/dormand_prince/dp_event.h"
#include "solve/dormand_prince/dp_kink.h"
#include "solve/dormand_prince/dp_motion.h"
#include "solve/dormand_prince/dp_stages.h"

enum { ITERATIONS_MAX = 60 };

// A correction of the instant of an event, as a share of the step, after which the step is taken a
// last time; one of its square would be too small to matter. Where a law is only changed the
// instant may be wrong by the tolerance, but not where that would be before a turn, which would
// come again; where a history is committed, or velocities jump, it may not.
static const double located[] = {
    [DP_CLOSE] = 3e-3, [DP_OPEN] = 3e-3,   [DP_KINK] = 3e-3,   [DP_TURN] = 1e-4,
    [DP_MEET] = 1e-7,  [DP_BRANCH] = 1e-7, [DP_UNLOAD] = 1e-7,
};

// What passes through zero at the event, at the end of the step, and its rate.
static double value_at_end(const struct dp *p, double *rate) {
    const struct dp_event *e = &p->event;
    if (e->kind == DP_KINK) {
        return dp_kink_at_end(p, e->index, rate);
    }
    struct motion m =
        dp_event_is_of_storey(e) ? dp_motion_storey(p, e->index) : dp_motion_link(p, e->index);
    if (e->kind == DP_TURN || e->kind == DP_UNLOAD) {
        *rate = m.a[1];
        return m.v[1];
    }
    *rate = m.v[1];
    return m.d[1] - e->target;
}

// Takes the step again, of length h.
static void retake(struct dp *p, double h) {
    dp_stages_take(p, h, p->now.time + h);
    dp_stages_gaps(p, &p->next, p->rate[1]);
}

void dp_locate(struct dp *p) {
    double sign = p->event.direction > 0.0 ? 1.0 : -1.0;
    double whole = p->h;
    double low = 0.0;
    double high = whole;
    double h = p->event.place * whole;
    double near = fmin(located[p->event.kind], sqrt(p->model->control.tolerance));
    bool is_kink = p->event.kind == DP_KINK;  // which has to be passed, or it would come again
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        retake(p, h);
        double rate;
        double value = value_at_end(p, &rate);
        if (value == 0.0) {
            break;
        }
        *(sign * value > 0.0 ? &high : &low) = h;
        double next = h - value / rate;
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        double correction = fabs(next - h) / whole;
        bool passed = value <= 0.0 || !is_kink;
        if (correction <= near * near && passed) {
            break;
        }
        h = passed ? next : fmin(next + near * near * whole, whole);
        if (correction <= near && !is_kink) {
            retake(p, h);
            break;
        }
    }
    p->event.place = 1.0;
    dp_motion_reach(p);
}
