// SPDX-License-Identifier: GPL-3.0-or-later
// The contact sweep, written once for the lane counts of core/masks.h: one link of one run
// (sweep.c, contact.c, contact_step.c), and one contact of eight runs (ensemble_sweeps.c).
//
// With the corrections q of the accelerations, a link has x = q_left - q_right, and
//     d = d_trial + b x,   v = v_trial + g x,   F = F(d, v),   b = beta h^2,   g = gamma h.
// Its own force f moves it by S_ll per unit against itself, so Newton's method for F = f takes
//     df = (F - f) / (1 + S_ll t),   t = b dF/dd + g dF/dv,
// and q changes by df times the columns of A^-1 of both ends.
//
// Once a law has been evaluated at some x, its tangent replaces it: df = base + rate dx. It must be
// evaluated again where that is not accurate enough. With F = k d^n a change of d by dx changes F
// by (n - 1) / (2 n) c^2 / f more than the tangent says, c = t dx. A dashpot that grows with
// d^(1/4) has at most 3/2 of that. The bound here is 4 c^2 / f, with the absolute values of both
// parts of t, as they may cancel where a law pulls.
#ifndef JOSTLE_SWEEP_STEP_H
#define JOSTLE_SWEEP_STEP_H

#include <float.h>
#include <math.h>

#include "core/masks.h"
#include "solve/floors/floor_terms.h"

// Whether the law of a link must be evaluated again.
enum knowledge { LAW_KNOWN, LAW_UNKNOWN };

// What differs with the lane count: structs, and these functions, which are declared before this
// header is included.
//     sweep_see(w, p, &x)             x of link p
//     sweep_law(p, &d, &v, &law)      what its law says at d and v
//     sweep_sizes(w, p, &u, &v, &q)   sizes of the trial displacements (with the gap), of the trial
//                                     velocities and of the corrections at its ends
//     sweep_push(w, p, &df)           the change of q by a change df of its force
#ifdef LANES_OF_RUNS
#define SWEEP_RUN struct ensemble_lanes
#define SWEEP_SCHEME(w) (&(w)->scheme)
#define SWEEP_LINK struct closed_contact
#define SWEEP_PROGRESS struct progress_lanes
#define SWEEP_RESPONSE struct response_lanes
#define IS_SAFE_AT(p, d) LESS(0.0, d)
#define SAFE_RANGE(p, range) (range)
#define DEPTH(p) (&(p)->depth)

LANE_INLINE void sweep_root(lane_number *x) {
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        (*x)[lane] = sqrt((*x)[lane]);
    }
}
#else
#include "solve/contact/contact.h"

#define SWEEP_RUN struct work
#define SWEEP_SCHEME(w) (w)
#define SWEEP_LINK struct link_scratch
#define SWEEP_PROGRESS struct progress
#define SWEEP_RESPONSE struct contact_response
#define IS_SAFE_AT(p, d) ((p)->trusted && ((d) > 0.0 || (p)->bilateral))
#define SAFE_RANGE(p, range) ((p)->bilateral ? INFINITY : (range))
#define DEPTH(p) (&(p)->resolved->depth)

LANE_INLINE void sweep_root(lane_number *x) {
    *x = sqrt(*x);
}
#endif

// A Newton step is safe if it changes force and penetration by no more than this share, and if the
// slope of the law times the flexibility of the link, S_ll t, is no more than this.
static const double SWEEP_NEAR = 0.1;
static const double SWEEP_STEEPEST = 0.1;

// Changes below this share of the tolerance are not made.
static const double SWEEP_NEGLECTED = 0.1;

// A force f may follow the slope of its law by a change c as long as 4 c^2 / f does not matter.
static const double SWEEP_STRAIGHT = 0.1 / 4.0;

// What was settled to a tolerance looser by this factor still is.
static const double SWEEP_LOOSER = 4.0;

// Largest k S h^2 of a spring k: (pi / 10)^2; and the decay that the dashpot of a law may cause.
static const double SWEEP_COARSEST_SPRING = 0.09869604401089358;
static const double SWEEP_COARSEST_DASHPOT = 0.5;

// A smooth law is no more than so many times as stiff at a penetration so many times as deep.
static const double SWEEP_STIFFER = 4.0;
static const double SWEEP_DEEPER = 2.0;

// A first guess of a force: the polynomial through that of the last step, f, and those before.
#define SWEEP_GUESS(f, past, n_past)                                                               \
    CHOOSE(IS_EQUAL(n_past, PAST_STEPS), 4.0 * ((f) + (past)[1]) - 6.0 * (past)[0] - (past)[2],    \
           CHOOSE(IS_EQUAL(n_past, 2), 3.0 * ((f) - (past)[0]) + (past)[1],                        \
                  CHOOSE(IS_EQUAL(n_past, 1), 2.0 * (f) - (past)[0], f)))

// Takes the tangent of the law of a link, evaluated at x, where S_ll t is `share`, in lanes
// `which`. Where steps may lead as far as `range` from there. A law that is not smooth has no
// reach: it is evaluated in each step.
LANE_INLINE void sweep_linearise(const SWEEP_RUN *w, SWEEP_LINK *p, const SWEEP_PROGRESS *s,
                                 const lane_number *x, const lane_number *v,
                                 const lane_number *range, const SWEEP_RESPONSE *law,
                                 const lane_number *slope, const lane_number *share,
                                 const lane_mask *which) {
    const lane_number steepness = ABSOLUTE(SWEEP_SCHEME(w)->b * law->dfdd) +
                                  ABSOLUTE(SWEEP_SCHEME(w)->g * law->dfdv) + DBL_MIN;
    const lane_number inverse = 1.0 / ((1.0 + *share) * steepness);  // one division for both
    const lane_number damped = inverse * steepness, rate = *slope * damped,
                      base = (law->force - p->force) * damped;
    lane_number bend = SWEEP_STRAIGHT * s->tolerance * ABSOLUTE(law->force);
    sweep_root(&bend);
    const lane_number straight = bend * inverse * (1.0 + *share);
    const lane_number turn = ABSOLUTE(*v) * SWEEP_SCHEME(w)->per_g;
    const lane_number nearer = SMALLER(*range, turn);
    const lane_number smooth = SMALLER(nearer, straight), none = EVERYWHERE(-1.0);
    const lane_number reach = p->law->traits & CONTACT_SMOOTH ? smooth : none;
    p->tangent.origin = CHOOSE(*which, *x, p->tangent.origin);
    p->tangent.range = CHOOSE(*which, *range, p->tangent.range);
    p->tangent.damped = CHOOSE(*which, damped, p->tangent.damped);
    p->tangent.rate = CHOOSE(*which, rate, p->tangent.rate);
    p->tangent.base = CHOOSE(*which, base, p->tangent.base);
    p->tangent.reach = CHOOSE(*which, reach, p->tangent.reach);
    p->dfdd = CHOOSE(*which, law->dfdd, p->dfdd);
    p->dfdv = CHOOSE(*which, law->dfdv, p->dfdv);
}

// Evaluates the law of a link at x in lanes `which`; *safe: in those a Newton step may start there.
LANE_INLINE void sweep_evaluate(const SWEEP_RUN *w, SWEEP_LINK *p, const lane_number *x,
                                const lane_mask *which, SWEEP_PROGRESS *s, lane_mask *safe) {
    const lane_number d = END(p->d_trial, SWEEP_SCHEME(w)->b, *x);
    const lane_number v = END(p->v_trial, SWEEP_SCHEME(w)->g, *x);
    p->stale = p->stale OR * which;
    *safe = *which AND IS_SAFE_AT(p, d);
    if (!ANY(*safe)) {
        return;
    }
    SWEEP_RESPONSE law;
    sweep_law(p, &d, &v, &law);
    const lane_number slope = SWEEP_SCHEME(w)->b * law.dfdd + SWEEP_SCHEME(w)->g * law.dfdv;
    const lane_number share = p->flexibility * slope;
    *safe = *safe AND AT_MOST(0.0, share) AND AT_MOST(share, SWEEP_STEEPEST);
    if (!ANY(*safe)) {
        return;
    }
    const lane_number range = SAFE_RANGE(p, SWEEP_NEAR * d * SWEEP_SCHEME(w)->per_b);
    sweep_linearise(w, p, s, x, &v, &range, &law, &slope, &share, safe);
    p->stale = p->stale AND NOT(*safe);
    const lane_number feedback = share * p->coupling;
    s->feedback = CHOOSE(*safe AND LESS(s->feedback, feedback), feedback, s->feedback);
}

// Takes lanes out of `which` in which a change of that size of the force is no more than the
// rounding of d and v makes of it.
LANE_INLINE void sweep_without_rounding(const SWEEP_RUN *w, const SWEEP_LINK *p,
                                        const lane_number *size, lane_mask *which) {
    lane_number u, v, q;
    sweep_sizes(w, p, &u, &v, &q);
    const lane_number d_size = u + SWEEP_SCHEME(w)->b * q, v_size = v + SWEEP_SCHEME(w)->g * q;
    const lane_number rounding = 4.0 * DBL_EPSILON *
                                 (ABSOLUTE(p->dfdd) * d_size + ABSOLUTE(p->dfdv) * v_size) *
                                 p->tangent.damped;
    *which = *which AND NOT(AT_MOST(*size, rounding));
}

// Records changes df of a force in lanes `which`, by whether the law must be evaluated again.
LANE_INLINE void sweep_note(const SWEEP_RUN *w, const SWEEP_LINK *p, const lane_number *df,
                            const lane_mask *which, SWEEP_PROGRESS *s) {
    const lane_number size = ABSOLUTE(*df);
    lane_number *known = &s->moved[LAW_KNOWN], *unknown = &s->moved[LAW_UNKNOWN];
    const lane_number most = CHOOSE(p->stale, *unknown, *known);
    lane_mask matters = *which AND LESS(s->tolerance, size) AND LESS(most, size);
    if (ANY(matters)) {
        sweep_without_rounding(w, p, &size, &matters);
        *unknown = CHOOSE(matters AND p->stale, size, *unknown);
        *known = CHOOSE(matters AND NOT(p->stale), size, *known);
    }
}

// A link that is `far` from the origin of its tangent stays within its reach as long as the forces
// of others change by no more than this.
LANE_INLINE void sweep_limit(const SWEEP_LINK *p, const lane_number *far, const lane_mask *which,
                             SWEEP_PROGRESS *s) {
    const lane_number left = p->tangent.reach - *far;
    const lane_number margin = LARGER(left, EVERYWHERE(0.0)) * p->per_coupling;
    s->margin = CHOOSE(*which AND LESS(margin, s->margin), margin, s->margin);
}

// Changes the force of a link by df in lanes `which`, which leads it `far` from the origin of its
// tangent.
LANE_INLINE void sweep_change(const SWEEP_RUN *w, SWEEP_LINK *p, const lane_number *df,
                              const lane_number *far, const lane_mask *which, SWEEP_PROGRESS *s) {
    const lane_number done = CHOOSE(*which, *df, EVERYWHERE(0.0));
    p->force = CHOOSE(*which, p->force + *df, p->force);
    p->tangent.base -= p->tangent.damped * done;
    p->stale = (*which AND NOT(AT_MOST(*far, p->tangent.reach)))OR(NOT(*which) AND p->stale);
    sweep_limit(p, far, which, s);
    sweep_push(w, p, &done);
    sweep_note(w, p, &done, which, s);
}

// A Newton step of a link at x in lanes `which`, of which those stay in which it is safe. It is not
// made where it does not matter.
LANE_INLINE void sweep_step(const SWEEP_RUN *w, SWEEP_LINK *p, const lane_number *x,
                            lane_mask *which, SWEEP_PROGRESS *s) {
    const lane_number dx = *x - p->tangent.origin, size = ABSOLUTE(dx);
    const lane_number df = p->tangent.base + p->tangent.rate * dx;
    const lane_mask idle = *which AND AT_MOST(ABSOLUTE(df), SWEEP_NEGLECTED * s->tolerance)
                               AND AT_MOST(size, p->tangent.reach);
    lane_mask moves = *which AND NOT(idle);
    if (ANY(idle)) {
        sweep_limit(p, &size, &idle, s);
    }
    if (!ANY(moves)) {
        return;
    }
    const lane_number far = ABSOLUTE(dx - p->flexibility * df);
    moves = moves AND AT_MOST(far, p->tangent.range)
        AND AT_MOST(ABSOLUTE(df), SWEEP_NEAR * ABSOLUTE(p->force));
    *which = idle OR moves;
    if (ANY(moves)) {
        sweep_change(w, p, &df, &far, &moves, s);
    }
}

// The turn of a link in lanes `which`, of which those stay in which a Newton step is safe.
LANE_INLINE void sweep_visit(const SWEEP_RUN *w, SWEEP_LINK *p, lane_mask *which,
                             SWEEP_PROGRESS *s) {
    lane_number x;
    sweep_see(w, p, &x);
    const lane_number far = ABSOLUTE(x - p->tangent.origin);
    const lane_mask on_tangent = AT_MOST(far, p->tangent.reach) OR AT_MOST(far, 0.0);
    const lane_mask known = *which AND NOT(p->stale) AND on_tangent;
    const lane_mask unknown = *which AND NOT(known);
    *which = known;
    if (ANY(unknown)) {
        lane_mask safe;
        sweep_evaluate(w, p, &x, &unknown, s, &safe);
        *which = known OR safe;
    }
    sweep_step(w, p, &x, which, s);
    const lane_number size = ABSOLUTE(p->force);
    s->largest = CHOOSE(*which AND LESS(s->largest, size), size, s->largest);
}

// Turns the progress of the last sweep, or of the guess, into that of a sweep about to begin.
LANE_INLINE void sweep_renew(const lane_number *tolerance, SWEEP_PROGRESS *s) {
    s->tolerance = *tolerance * s->largest;
    s->largest = s->moved[LAW_KNOWN] = s->moved[LAW_UNKNOWN] = EVERYWHERE(0.0);
    s->margin = EVERYWHERE(INFINITY);
}

// In which lanes of `which` has the tolerance become so much tighter that all laws must be
// evaluated again? That is taken for done.
LANE_INLINE void sweep_tighten(SWEEP_PROGRESS *s, lane_mask *which) {
    *which = *which AND LESS(SWEEP_LOOSER * s->tolerance, s->law_tolerance);
    s->law_tolerance =
        CHOOSE(*which OR LESS(s->law_tolerance, s->tolerance), s->tolerance, s->law_tolerance);
}

// After a sweep, would another one change no force by more than the tolerance, a share of the
// largest? Changes of forces on their tangents count by the share `feedback` that comes back from
// the other links.
LANE_INLINE void sweep_settled(const SWEEP_PROGRESS *s, const lane_number *tolerance,
                               const lane_number *feedback, lane_mask *settled) {
    const lane_number allowed = *tolerance * s->largest;
    *settled = AT_MOST(s->moved[LAW_UNKNOWN], allowed)
        AND AT_MOST(*feedback * s->moved[LAW_KNOWN], allowed)
            AND NOT(LESS(s->margin, s->moved[LAW_KNOWN]));
}

// Was the tolerance by which the sweep measured changes not much looser than it is now?
LANE_INLINE void sweep_measured(const SWEEP_PROGRESS *s, const lane_number *tolerance,
                                lane_mask *measured) {
    const lane_number allowed = *tolerance * s->largest;
    *measured = AT_MOST(s->tolerance, SWEEP_LOOSER * allowed);
}

// Is the step short enough for the dashpot of a link with that dF/dv?
#define SWEEP_FITS_DASHPOT(w, p, dfdv)                                                             \
    AT_MOST(SWEEP_SCHEME(w)->g *(p)->flexibility *(dfdv), SWEEP_COARSEST_DASHPOT)

// Is a step of length h short enough for its spring at penetrations d in lanes `which`, of which
// those stay in which it is? Its tangents there are in `law`. Keeps how deep the answer holds.
LANE_INLINE void sweep_fit_spring(SWEEP_LINK *p, double h, const SWEEP_RESPONSE *law,
                                  const lane_number *d, lane_mask *which) {
    const lane_mask deeper = *which AND NOT(AT_MOST(*d, *DEPTH(p)));
    if (!ANY(deeper)) {
        return;
    }
    const lane_mask simple = IS_EQUAL(law->dfdv, 0.0) AND LESS(0.0, law->dfdd);
    const lane_number still = EVERYWHERE(0.0);
    const lane_mask other = deeper AND NOT(simple);
    lane_number stiffness = law->dfdd;
    if (ANY(other)) {
        SWEEP_RESPONSE at_rest;
        sweep_law(p, d, &still, &at_rest);
        stiffness = CHOOSE(simple, stiffness, at_rest.dfdd);
    }
    const lane_number coarse = stiffness * p->flexibility * h * h;
    const double deepest = p->law->traits & CONTACT_SMOOTH ? SWEEP_DEEPER : 0.0;
    const lane_number depth =
        CHOOSE(AT_MOST(SWEEP_STIFFER * coarse, SWEEP_COARSEST_SPRING), deepest * *d, still);
    *DEPTH(p) = CHOOSE(deeper, depth, *DEPTH(p));
    *which = *which AND(NOT(deeper) OR AT_MOST(coarse, SWEEP_COARSEST_SPRING));
}

#endif
