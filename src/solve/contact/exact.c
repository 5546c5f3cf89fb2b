// SPDX-License-Identifier: GPL-3.0-or-later
// Solves g(f) = f - F(d(f), v(f)) = 0. Where F does not decrease with d and v, g increases by at
// least as much as f, so the root is unique, and it is bracketed: F(d(0), v(0)) has the sign of the
// root and is at least as large, and d = 0 bounds f from above by d_free / d_force. Newton steps
// that leave the bracket are replaced by bisection, so the search ends whatever the law is.
//
// At d = 0 the force may jump from 0 to F(0+, v). If that is more than the force that holds the
// link at d = 0, the graph of the law is crossed inside the jump, and that force is the solution.
#include "solve/contact/contact.h"

#include <float.h>
#include <math.h>

#include "core/number.h"
#include "core/root.h"
#include "solve/contact/sweep_step.h"

// A change of a force by less than this share of it may come from rounding errors in the others.
static const double SMALL = 1e-8;

// A Newton step as small as this, relative to the force, leaves an error of the order of its
// square.
static const double SQUARED = 1e-9;

// A velocity too small to change a force, but with a sign for the law.
static const double SMALLEST = DBL_MIN;

enum { NEWTON_MAX = 25, ITERATIONS_MAX = 200, EXPANSIONS_MAX = 200, HALVINGS = 60 };

struct contact_response exact_law(const struct equation *e, double force) {
    double d = e->d_free - e->d_force * force;
    double v = e->v_free - e->v_force * force;
    if (!e->link->bilateral) {
        d = number_max(d, 0.0);
    }
    struct contact_response r = e->link->law->force(e->link->constant, e->history, d, v);
    return e->clamped && r.force < 0.0 ? (struct contact_response){0} : r;
}

static double exact_residual(const struct equation *e, double f) {
    return f - exact_law(e, f).force;
}

// force - F(d(f), v(f)), with no force where d < 0.
static double exact_residual_of(const struct equation *e, double force, double f) {
    bool apart = !e->link->bilateral && e->d_free - e->d_force * f < 0.0;
    return force - (apart ? 0.0 : exact_law(e, f).force);
}

// g at v = 0, reached from the side of `v`.
static double exact_residual_at_rest(const struct equation *e, double f, double v) {
    struct equation at_rest = *e;
    at_rest.v_free = v;
    at_rest.v_force = 0.0;
    return exact_residual(&at_rest, f);
}

// The root of g in [low, high], g(low) <= 0 <= g(high). Where v = 0 the law may jump or have a
// kink: the root is there, or on one side.
static double exact_search(const struct equation *e, double low, double high, double guess) {
    struct root within = {low, high, 1.0};
    const double rest = e->v_free / e->v_force;
    if (rest > low && rest < high) {
        bool above = exact_residual_at_rest(e, rest, -SMALLEST) < 0.0;
        if (!above && exact_residual_at_rest(e, rest, SMALLEST) <= 0.0) {
            return rest;
        }
        *(above ? &within.low : &within.high) = rest;
    }
    bool inside = guess > within.low && guess < within.high;
    double f = inside ? guess : root_middle(&within);
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        struct contact_response r = exact_law(e, f);
        double g = f - r.force;
        if (g == 0.0) {
            return f;
        }
        root_narrow(&within, f, g);
        double next = f - g / (1.0 + e->d_force * r.dfdd + e->v_force * r.dfdv);
        bool newton = i < NEWTON_MAX && next >= within.low && next <= within.high;
        next = newton ? next : within.low + 0.5 * (within.high - within.low);
        if (fabs(next - f) <= (newton ? SQUARED : DBL_EPSILON) * fabs(f) || next == f) {
            return next;
        }
        f = next;
    }
    return f;
}

// The other end of a bracket that ends at 0 or above, from a force `end` on: below, as a force of
// tension grows, d and v do, until no law pulls; above, as the force of a link that softens grows.
static double exact_bracket(const struct equation *e, double end) {
    const double sign = copysign(1.0, end);
    while (sign * exact_residual(e, end) < 0.0) {
        end *= 2.0;
    }
    return end;
}

// The root that is no more than `top`, which bounds it from above.
static double exact_root(const struct equation *e, double top, double guess) {
    double f = exact_law(e, 0.0).force;
    if (f < 0.0) {
        return exact_search(e, exact_bracket(e, f), 0.0, guess);
    }
    const bool softens = e->link->law->traits & CONTACT_TURNS;
    return exact_search(e, 0.0, softens ? exact_bracket(e, f) : fmin(top, f), guess);
}

double exact_excess(const struct equation *e, double force) {
    if (e->link->law->rebound) {
        return force - (e->v_free - e->v_rest) / e->v_force;
    }
    double at = exact_residual_of(e, force, force);
    struct root r = {force, force, 1.0};
    double *end = at < 0.0 ? &r.high : &r.low;
    double way = at < 0.0 ? 1.0 : -1.0;
    double width = 1e-6 * (fabs(force) + fabs(e->v_free / e->v_force)) + DBL_MIN;
    for (int i = 0; i < EXPANSIONS_MAX && exact_residual_of(e, force, *end) * at > 0.0; i++) {
        *end = force + way * width;
        width *= 4.0;
    }
    for (int i = 0; i < HALVINGS && r.low < r.high; i++) {
        root_halve(&r, exact_residual_of(e, force, root_middle(&r)) < 0.0);
    }
    return force - root_middle(&r);
}

enum branch exact_force(const struct equation *e, double guess, double *force) {
    const bool pulls = !e->clamped && (e->link->law->traits & CONTACT_MAY_PULL);
    const double top = e->d_free / e->d_force;  // the force that holds the link at d = 0
    *force = 0.0;
    if (e->link->law->rebound) {
        // A rigid contact at rest: the bodies are kept together, unless that would have to pull.
        double excess = e->v_free - e->v_rest;
        *force = number_max(excess / e->v_force, 0.0);
        return excess >= -e->v_rounding ? BRANCH_JUMP : BRANCH_OPEN;
    }
    if (e->link->bilateral || e->held || (e->d_free > 0.0 && !(e->d_force > 0.0))) {
        *force = exact_root(e, INFINITY, guess);
        return BRANCH_CLOSED;
    }
    if (e->d_free > 0.0) {
        // There is no open solution.
        bool jumps = exact_residual(e, top) < 0.0;
        *force = jumps ? top : exact_root(e, top, guess);
        return !jumps ? BRANCH_CLOSED : e->closed && pulls ? BRANCH_NONE : BRANCH_JUMP;
    }
    // Does a law that pulls do so hard enough at d = 0 to keep a closed link closed? A tension that
    // grows with d does not, as it is 0 there: such a link opens.
    if (!e->closed || !(e->d_force > 0.0) || !pulls) {
        return BRANCH_OPEN;
    }
    double low = exact_law(e, top).force;
    if (low >= top) {
        return BRANCH_OPEN;
    }
    *force = exact_search(e, exact_bracket(e, low), top, guess);
    return BRANCH_CLOSED;
}

struct equation exact_equation(const struct work *w, const struct state *now,
                               const struct state *next, int k) {
    const struct link_scratch *p = &w->link[k];
    const struct link *l = p->link;
    double s = p->flexibility;
    double corrected = sweep_across(p, w->correction) + s * p->force;
    return (struct equation){
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

double exact_solve(struct work *w, const struct state *now, struct state *next, int k) {
    struct link_scratch *p = &w->link[k];
    struct equation e = exact_equation(w, now, next, k);
    double force;
    p->branch = exact_force(&e, p->force, &force);
    double df = force - p->force;
    sweep_push(w, p, &df);
    p->force = force;
    return df;
}

// Is a change of the force no more than what rounding errors of d and v make of it? Rounding in
// other links' forces counts too where the change is small and the sweeps have been going on for
// long.
static bool exact_negligible(const struct work *w, const struct equation *e, enum branch branch,
                             double f, double df) {
    const double size = fabs(df), corrected = state_rounding(e->link, w->correction);
    double d =
        state_rounding(e->link, w->u_trial) + w->b * corrected + 4.0 * DBL_EPSILON * e->link->gap;
    double v = state_rounding(e->link, w->v_trial) + w->g * corrected;
    if (size <= SMALL * fabs(f)) {
        d += w->others_d;
        v += w->others_v;
    }
    if (!(e->v_force * size <= v || e->d_force * size <= d)) {
        return false;
    }
    if (e->link->law->rebound || f == e->v_free / e->v_force) {
        return size <= v / e->v_force;
    }
    double noise = e->d_force > 0.0 ? d / e->d_force : 0.0;
    if (branch == BRANCH_CLOSED) {
        struct contact_response r = exact_law(e, f);
        double change = (fabs(r.dfdd) * d + fabs(r.dfdv) * v) / (1.0 + fabs(exact_slope(e, &r)));
        noise = isfinite(change) ? change : noise;
    }
    return size <= noise;
}

void exact_visit(struct work *w, const struct state *now, struct state *next,
                 struct link_scratch *p, struct progress *s) {
    int k = p->index;
    const struct contact_law *law = p->link->law;
    double df = exact_solve(w, now, next, k);
    bool jumps = law->traits & CONTACT_JUMPS;
    bool pulls = law->traits & CONTACT_MAY_PULL;
    p->trusted = p->branch == BRANCH_CLOSED && law->force && !p->clamped &&
                 (now->link[k].closed || !(jumps || pulls));
    p->open = p->branch == BRANCH_OPEN && law->force && !(now->link[k].closed && pulls);
    p->stale = true;
    s->some_exact = true;
    s->largest = number_max(s->largest, fabs(p->force));
    if (fabs(df) > s->moved[LAW_UNKNOWN]) {
        struct equation e = exact_equation(w, now, next, k);
        if (!exact_negligible(w, &e, p->branch, p->force, df)) {
            s->moved[LAW_UNKNOWN] = fabs(df);
        }
    }
}
