// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a run in which a storey reaches its limit of drift. The instant is first read from the
// cubic of its drift in the step. Steps from the start of the step to it then mend it by Newton's
// method, until the drift has passed the limit by less than LOCATED of it.
#include <math.h>

#include "core/root.h"
#include "model/foundation.h"
#include "solve/event/hermite.h"
#include "solve/newmark/newmark.h"
#include "solve/run.h"

enum { LOCATIONS_MAX = 40 };
static const double LOCATED = 1e-9;

// The first storey to reach its limit in the step, and when; -1: none does.
static int collapse_first(const struct run *r, double h, double *time) {
    const struct model *m = r->model;
    int first = -1;
    *time = INFINITY;
    for (int i = 0; i < m->n_dof; i++) {
        const double limit = m->collapse[i], drift = foundation_across(m, i, r->next->u);
        if (fabs(drift) < limit) {
            continue;
        }
        const double sign = copysign(1.0, drift);
        const struct path path = {sign * foundation_across(m, i, r->now->u) - limit,
                                  sign * foundation_across(m, i, r->now->v), fabs(drift) - limit,
                                  sign * foundation_across(m, i, r->next->v), h};
        double rate;
        // In lockstep a run may be beyond its limit already, and will be run again.
        const double at = path.d0 < 0.0 ? hermite_crossing(&path, &rate) : h;
        if (at < *time) {
            first = i;
            *time = at;
        }
    }
    return first;
}

// Makes r->next the state after a step of h. Returns its status.
static int collapse_step(struct run *r, double end, double whole, double h) {
    return newmark_step(&r->work, r->now, r->next, h < whole ? r->now->time + h : end, h, r->error);
}

int collapse_newmark(struct run *r) {
    const struct model *m = r->model;
    const double whole = r->work.h, end = r->next->time;
    double h;
    const int i = collapse_first(r, whole, &h);
    if (i < 0) {
        return STATUS_OK;
    }
    const double sign = copysign(1.0, foundation_across(m, i, r->next->u));
    const double limit = m->collapse[i], wanted = limit * (1.0 + LOCATED / 2.0);
    struct root within = {0.0, whole, 1.0};
    int status = STATUS_OK;
    for (int n = 0; n <= LOCATIONS_MAX && status == STATUS_OK; n++) {
        h = n < LOCATIONS_MAX ? h : within.high;
        status = collapse_step(r, end, whole, h);
        const double drift = sign * foundation_across(m, i, r->next->u);
        if (status == STATUS_OK && drift >= limit && drift <= limit * (1.0 + LOCATED)) {
            break;
        }
        root_narrow(&within, h, drift - wanted);
        h = root_step(&within, h, drift - wanted, sign * foundation_across(m, i, r->next->v));
    }
    if (status == STATUS_OK) {
        r->results->collapse =
            (struct collapse){true, i, r->next->time, foundation_across(m, i, r->next->u)};
    }
    return status;
}
