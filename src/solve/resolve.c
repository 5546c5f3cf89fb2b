// SPDX-License-Identifier: GPL-3.0-or-later
// Resolved means ten steps in a contact of constant stiffness, k S h^2 <= (pi / 10)^2, and the
// decay that the dashpot of the law alone would cause, gamma h S dF/dv <= 1/2, at both ends of the
// step; S is the flexibility of the link. k is the slope of the law at v = 0: with v, Jankowski's
// is infinite at every closure.
#include "solve/resolve.h"

#include <math.h>

#include "solve/contact.h"
#include "solve/crossing.h"

static const double COARSEST_SPRING = 0.09869604401089358;  // (pi / 10)^2
static const double COARSEST_DASHPOT = 0.5;

// A pressed contact that moves by less than this share of its penetration, and would at its
// velocity, is at rest: the law is linear over such a step, and average acceleration keeps its
// energy.
static const double AT_REST = 0.1;

// Velocity relative to the largest of any floor so far.
static const double NEGLIGIBLE = 1e-5;

bool resolve_negligible(const struct work *w, double velocity) {
    return fabs(velocity) <= NEGLIGIBLE * w->totals->speed;
}

static bool resolved_at(const struct work *w, const struct line *line, double d, double v) {
    const struct link *l = line->link;
    double depth = fmax(d, 0.0);
    struct contact_response r = l->law->force(l->constant, line->history, depth, v);
    double stiffness = r.dfdv == 0.0 && r.dfdd > 0.0
                           ? r.dfdd
                           : l->law->force(l->constant, line->history, depth, 0.0).dfdd;
    double flexibility = line->v_force / w->g;
    return stiffness * flexibility * w->h * w->h <= COARSEST_SPRING &&
           line->v_force * r.dfdv <= COARSEST_DASHPOT;
}

static bool at_rest(const struct work *w, const struct path *p) {
    double allowed = AT_REST * fmin(p->d0, p->d1);
    double fastest = fmax(fabs(p->v0), fabs(p->v1));
    return fabs(p->d1 - p->d0) <= allowed && fastest * w->h <= allowed;
}

// The start of the step was the end of the last one, and need not be looked at again where that was
// resolved with a step as long.
static bool starts_resolved(const struct work *w, const struct state *now, int k,
                            const struct line *line, const struct path *path) {
    bool seen = w->checked[k] >= w->h && now->t_close[k] < now->time;
    return !now->closed[k] || seen || resolved_at(w, line, path->d0, path->v0);
}

static bool resolved(struct work *w, const struct state *now, const struct state *next, int k) {
    struct line line = contact_line(w, now, next, k);
    double f = next->force[k];
    struct path path = {now->delta[k], state_rate(now, w->model, k), line.d_free - line.d_force * f,
                        line.v_free - line.v_force * f, w->h};
    bool ends_closed = w->branch[k] == BRANCH_CLOSED;
    if (starts_resolved(w, now, k, &line, &path) &&
        (!ends_closed || resolved_at(w, &line, path.d1, path.v1))) {
        w->checked[k] = w->h;
        return true;
    }
    w->checked[k] = 0.0;
    if (now->closed[k] && ends_closed) {
        return at_rest(w, &path);
    }
    return resolve_negligible(w, path.v1) &&
           resolve_negligible(w, now->closed[k] ? path.v0 : next->v_close[k]);
}

bool resolve_suffices(struct work *w, const struct state *now, const struct state *next) {
    for (int i = 0; i < next->n_live; i++) {
        int k = next->live[i];
        const struct link *l = &w->model->link[k];
        if (!l->bilateral && !l->law->rebound && !resolved(w, now, next, k)) {
            w->unresolved = k;
            return false;
        }
    }
    return true;
}
