// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/contact/answer.h"

#include <float.h>
#include <math.h>

#include "core/number.h"
#include "solve/contact/sweep_step.h"

// A change of a force by less than this share of it may come from rounding errors in the others.
static const double SMALL = 1e-8;

struct line answer_line(const struct work *w, const struct state *now, const struct state *next,
                        int k) {
    const struct link_scratch *p = &w->link[k];
    const struct link *l = p->link;
    double s = p->flexibility;
    double corrected = sweep_across(p, w->correction) + s * p->force;
    return (struct line){
        .link = l,
        .history = next->link_history + l->history,
        .d_free = sweep_across(p, w->u_trial) - l->gap + w->b * corrected +
                  state_ground_gap(l, w->model, next->ground_u),
        .v_free = sweep_across(p, w->v_trial) + w->g * corrected +
                  state_ground_gap(l, w->model, next->ground_v),
        .d_force = w->b * s,
        .v_force = w->g * s,
        .v_rest = p->v_rest,
        .v_rounding = l->law->rebound ? state_rounding(l, w->v_trial) : 0.0,
        .closed = now->link[k].closed,
        .clamped = p->clamped,
        .held = now->link[k].closed && k == w->held,
    };
}

double answer_link(struct work *w, const struct state *now, struct state *next, int k) {
    struct link_scratch *p = &w->link[k];
    struct line line = answer_line(w, now, next, k);
    double force;
    p->branch = line_answer(&line, p->force, &force);
    double df = force - p->force;
    sweep_push(w, p, &df);
    p->force = force;
    return df;
}

double answer_rounding(const struct work *w, const double *x) {
    double largest = 0.0;
    for (int i = 0; i < w->gaps.n_touched; i++) {
        const struct building *g = &w->model->building[w->gaps.touched[i]];
        for (int j = g->first; j < g->first + g->n_floor; j++) {
            largest = number_max(largest, fabs(x[j]));
        }
    }
    return 16.0 * DBL_EPSILON * largest;
}

// How much rounding errors d and v change the force of a link.
static double noise(const struct line *l, enum branch branch, double f, double d, double v) {
    if (l->link->law->rebound || f == l->v_free / l->v_force) {
        return v / l->v_force;
    }
    if (branch == BRANCH_CLOSED) {
        struct contact_response r = line_law(l, f);
        double slope = l->d_force * r.dfdd + l->v_force * r.dfdv;
        double change = (fabs(r.dfdd) * d + fabs(r.dfdv) * v) / (1.0 + fabs(slope));
        if (isfinite(change)) {
            return change;
        }
    }
    return l->d_force > 0.0 ? d / l->d_force : 0.0;
}

// Is a change of the force no more than rounding? Rounding in other links' forces counts too where
// the change is small and the sweeps have been going on for long.
static bool negligible(const struct work *w, const struct line *l, enum branch branch, double f,
                       double df) {
    double corrected = state_rounding(l->link, w->correction);
    double d =
        state_rounding(l->link, w->u_trial) + w->b * corrected + 4.0 * DBL_EPSILON * l->link->gap;
    double v = state_rounding(l->link, w->v_trial) + w->g * corrected;
    if (fabs(df) <= SMALL * fabs(f)) {
        d += w->others_d;
        v += w->others_v;
    }
    bool maybe = l->v_force * fabs(df) <= v || l->d_force * fabs(df) <= d;
    return maybe && fabs(df) <= noise(l, branch, f, d, v);
}

void answer_exactly(struct work *w, const struct state *now, struct state *next,
                    struct link_scratch *p, struct progress *s) {
    int k = p->index;
    const struct contact_law *law = p->link->law;
    double df = answer_link(w, now, next, k);
    bool jumps = law->traits & CONTACT_JUMPS;
    bool pulls = law->traits & CONTACT_MAY_PULL;
    p->trusted = p->branch == BRANCH_CLOSED && law->force && !p->clamped &&
                 (now->link[k].closed || !(jumps || pulls));
    p->open = p->branch == BRANCH_OPEN && law->force && !(now->link[k].closed && pulls);
    p->stale = true;
    s->some_exact = true;
    s->largest = number_max(s->largest, fabs(p->force));
    if (fabs(df) > s->moved[LAW_UNKNOWN]) {
        struct line line = answer_line(w, now, next, k);
        if (!negligible(w, &line, p->branch, p->force, df)) {
            s->moved[LAW_UNKNOWN] = fabs(df);
        }
    }
}
