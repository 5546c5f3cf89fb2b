// SPDX-License-Identifier: GPL-3.0-or-later
// Solves g(f) = f - F(d(f), v(f)) = 0. Where F does not decrease with d and v, g increases by at
// least as much as f, so the root is unique, and it is bracketed: F(d(0), v(0)) has the sign of the
// root and is at least as large, and d = 0 bounds f from above by d_free / d_force. Newton steps
// that leave the bracket are replaced by bisection, so the search ends whatever the law is.
//
// At d = 0 the force may jump from 0 to F(0+, v). If that is more than the force that holds the
// link at d = 0, the graph of the law is crossed inside the jump, and that force is the answer.
#include "solve/contact/line.h"

#include <float.h>
#include <math.h>

#include "core/number.h"
#include "core/root.h"

// A Newton step as small as this, relative to the force, leaves an error of the order of its
// square.
static const double SQUARED = 1e-9;

// A velocity too small to change a force, but with a sign for the law.
static const double SMALLEST = DBL_MIN;

enum { NEWTON_MAX = 25, ITERATIONS_MAX = 200, EXPANSIONS_MAX = 200, HALVINGS = 60 };

struct contact_response line_law(const struct line *l, double force) {
    double d = l->d_free - l->d_force * force;
    double v = l->v_free - l->v_force * force;
    if (!l->link->bilateral) {
        d = number_max(d, 0.0);
    }
    struct contact_response r = l->link->law->force(l->link->constant, l->history, d, v);
    return l->clamped && r.force < 0.0 ? (struct contact_response){0} : r;
}

static bool pulls(const struct line *l) {
    return !l->clamped && (l->link->law->traits & CONTACT_MAY_PULL);
}

static double residual(const struct line *l, double f) {
    return f - line_law(l, f).force;
}

// force - F(d(f), v(f)), with no force where d < 0.
static double residual_of(const struct line *l, double force, double f) {
    bool apart = !l->link->bilateral && l->d_free - l->d_force * f < 0.0;
    return force - (apart ? 0.0 : line_law(l, f).force);
}

// g at v = 0, reached from the side of `v`.
static double residual_at_rest(const struct line *l, double f, double v) {
    struct line at_rest = *l;
    at_rest.v_free = v;
    at_rest.v_force = 0.0;
    return residual(&at_rest, f);
}

// Moves one end of the bracket to the force that makes v = 0, where the law may jump or have a
// kink. True if the root is there: both ends are.
static bool split_at_rest(const struct line *l, struct root *r) {
    double f = l->v_free / l->v_force;
    if (!(f > r->low && f < r->high)) {
        return false;
    }
    if (residual_at_rest(l, f, -SMALLEST) < 0.0) {
        r->low = f;
        return false;
    }
    r->high = f;
    if (residual_at_rest(l, f, SMALLEST) <= 0.0) {
        r->low = f;
    }
    return r->low == f;
}

// The root of g in [low, high], g(low) <= 0 <= g(high).
static double solve(const struct line *l, double low, double high, double f) {
    struct root within = {low, high, 1.0};
    if (split_at_rest(l, &within)) {
        return within.low;
    }
    if (!(f > within.low && f < within.high)) {
        f = root_middle(&within);
    }
    for (int i = 0; i < ITERATIONS_MAX; i++) {
        struct contact_response r = line_law(l, f);
        double g = f - r.force;
        if (g == 0.0) {
            return f;
        }
        root_narrow(&within, f, g);
        double next = f - g / (1.0 + l->d_force * r.dfdd + l->v_force * r.dfdv);
        bool newton = i < NEWTON_MAX && next >= within.low && next <= within.high;
        next = newton ? next : within.low + 0.5 * (within.high - within.low);
        if (fabs(next - f) <= (newton ? SQUARED : DBL_EPSILON) * fabs(f) || next == f) {
            return next;
        }
        f = next;
    }
    return f;
}

// Moves `low` down from a negative force until g(low) <= 0; false: nowhere.
static bool bracket_below(const struct line *l, double *low) {
    for (int i = 0; i < EXPANSIONS_MAX; i++) {
        if (residual(l, *low) <= 0.0) {
            return true;
        }
        *low *= 2.0;
    }
    return false;
}

// Root where d is free: bilateral links, and contacts whose d does not depend on the force (beta =
// 0).
static double unbounded(const struct line *l, double guess) {
    double f = line_law(l, 0.0).force;
    if (f >= 0.0) {
        return solve(l, 0.0, f, guess);
    }
    double low = f;
    return bracket_below(l, &low) ? solve(l, low, 0.0, guess) : f;
}

// d_free > 0: there is no open solution.
static enum branch pressed(const struct line *l, double guess, double *force) {
    double top = l->d_free / l->d_force;
    if (residual(l, top) < 0.0) {
        *force = top;
        return l->closed && pulls(l) ? BRANCH_NONE : BRANCH_JUMP;
    }
    double f = line_law(l, 0.0).force;
    if (f >= 0.0) {
        *force = solve(l, 0.0, fmin(top, f), guess);
    } else {
        double low = f;
        *force = bracket_below(l, &low) ? solve(l, low, 0.0, guess) : f;
    }
    return BRANCH_CLOSED;
}

// d_free <= 0 for a closed link of a law that pulls: does it pull hard enough at d = 0 to keep d >
// 0? A tension that grows with d does not, as it is 0 there: such a link opens.
static enum branch held(const struct line *l, double guess, double *force) {
    double high = l->d_free / l->d_force;
    double low = line_law(l, high).force;
    *force = 0.0;
    if (low >= high || !bracket_below(l, &low)) {
        return BRANCH_OPEN;
    }
    *force = solve(l, low, high, guess);
    return BRANCH_CLOSED;
}

double line_excess(const struct line *l, double force) {
    if (l->link->law->rebound) {
        return force - (l->v_free - l->v_rest) / l->v_force;
    }
    double at = residual_of(l, force, force);
    struct root r = {force, force, 1.0};
    double *end = at < 0.0 ? &r.high : &r.low;
    double way = at < 0.0 ? 1.0 : -1.0;
    double width = 1e-6 * (fabs(force) + fabs(l->v_free / l->v_force)) + DBL_MIN;
    for (int i = 0; i < EXPANSIONS_MAX && residual_of(l, force, *end) * at > 0.0; i++) {
        *end = force + way * width;
        width *= 4.0;
    }
    for (int i = 0; i < HALVINGS && r.low < r.high; i++) {
        root_halve(&r, residual_of(l, force, root_middle(&r)) < 0.0);
    }
    return force - root_middle(&r);
}

// A rigid contact at rest: the force that keeps the bodies together, unless it would have to pull.
static enum branch rest(const struct line *l, double *force) {
    double excess = l->v_free - l->v_rest;
    *force = number_max(excess / l->v_force, 0.0);
    return excess >= -l->v_rounding ? BRANCH_JUMP : BRANCH_OPEN;
}

enum branch line_answer(const struct line *l, double guess, double *force) {
    if (l->link->law->rebound) {
        return rest(l, force);
    }
    if (l->link->bilateral || l->held) {
        *force = unbounded(l, guess);
        return BRANCH_CLOSED;
    }
    if (l->d_free > 0.0) {
        if (l->d_force > 0.0) {
            return pressed(l, guess, force);
        }
        *force = unbounded(l, guess);
        return BRANCH_CLOSED;
    }
    if (l->closed && l->d_force > 0.0 && pulls(l)) {
        return held(l, guess, force);
    }
    *force = 0.0;
    return BRANCH_OPEN;
}
