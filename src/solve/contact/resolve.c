// SPDX-License-Identifier: GPL-3.0-or-later
// Resolved means ten steps in a contact of constant stiffness, k S h^2 <= (pi / 10)^2, and the
// decay that the dashpot of the law alone would cause, gamma h S dF/dv <= 1/2, at both ends of the
// step; S is the flexibility of the link. k is the slope of the law at v = 0: with v, Jankowski's
// is infinite at every closure.
#include "solve/contact/resolve.h"

#include <math.h>

#include "core/number.h"
#include "solve/event/crossing.h"

// A closed contact whose penetration changes by less than this share, in fact and at its velocity,
// is at rest: the law is linear over such a step, and average acceleration preserves its energy.
static const double AT_REST = 0.1;

// Velocity relative to the largest of any floor so far.
static const double NEGLIGIBLE = 1e-5;

bool resolve_negligible(const struct work *w, const struct state *now, double velocity) {
    return fabs(velocity) <= NEGLIGIBLE * floors_speed(w, now);
}

// Is a step short enough for a law that has the tangents `r` at d?
static bool fits(const struct work *w, struct link_scratch *p, struct contact_response r,
                 double d) {
    bool short_enough = SWEEP_FITS_DASHPOT(w, p, r.dfdv);
    sweep_fit_spring(p, w->h, &r, &d, &short_enough);
    return short_enough;
}

static bool resolved_at(const struct work *w, struct link_scratch *p, double d, double v) {
    double depth = number_max(d, 0.0);
    return fits(w, p, p->law->force(p->constant, p->history, depth, v), depth);
}

static bool at_rest(const struct work *w, const struct path *p) {
    double allowed = AT_REST * fmin(p->d0, p->d1);
    double fastest = fmax(fabs(p->v0), fabs(p->v1));
    return fabs(p->d1 - p->d0) <= allowed && fastest * w->h <= allowed;
}

// The start of the step was the end of the last one, and need not be looked at again where that was
// resolved with a step as long.
static bool starts_resolved(const struct work *w, const struct state *now, struct link_scratch *p) {
    int k = p->index;
    return !now->link[k].closed || p->resolved->step >= w->h ||
           resolved_at(w, p, now->delta[k], state_rate(now, w->model, k));
}

// A settled link has tangents already, taken close enough to the end of the step.
static bool ends_resolved(const struct work *w, struct link_scratch *p, const struct path *path) {
    return p->branch != BRANCH_CLOSED ||
           (!p->stale
                ? fits(w, p, (struct contact_response){.dfdd = p->dfdd, .dfdv = p->dfdv}, path->d1)
                : resolved_at(w, p, path->d1, path->v1));
}

static bool resolved(struct work *w, const struct state *now, const struct state *next,
                     struct link_scratch *p, double x, double d) {
    int k = p->index;
    struct path path = {.d0 = now->delta[k], .d1 = d, .v1 = p->v_trial + w->g * x, .h = w->h};
    if (starts_resolved(w, now, p) && ends_resolved(w, p, &path)) {
        p->resolved->step = w->h;
        return true;
    }
    p->resolved->step = 0.0;
    path.v0 = state_rate(now, w->model, k);
    if (now->link[k].closed && p->branch == BRANCH_CLOSED) {
        return at_rest(w, &path);
    }
    return resolve_negligible(w, now, path.v1) &&
           resolve_negligible(w, now, now->link[k].closed ? path.v0 : next->link[k].v_close);
}

bool resolve_judge(struct work *w, const struct state *now, const struct state *next,
                   struct link_scratch *p) {
    double x = sweep_across(p, w->correction);
    if (p->bilateral || p->law->rebound || resolved(w, now, next, p, x, p->d_trial + w->b * x)) {
        return true;
    }
    w->memory->unresolved = p->index;
    return false;
}
