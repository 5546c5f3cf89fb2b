// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of the force of a link, written once for the links of one run (contact_step.c,
// sweep.c, contact.c) and for one contact of several runs, a run a lane (ensemble_impacts.c,
// ensemble_sweeps.c). They agree to the bit because these are the same operations in the same
// order. What differs in type only is a macro.
//
// With the corrections q of the accelerations, a link has x = q_left - q_right, and
//     d = d_trial + b x,   v = v_trial + g x,   F = F(d, v),   b = beta h^2,   g = gamma h.
// Its own force f moves it by S_ll per unit against itself, so Newton's method for F = f takes
//     df = (F - f) / (1 + S_ll t),   t = b dF/dd + g dF/dv,
// and q changes by df times the columns of A^-1 of both ends.
//
// Once a law has been asked (evaluated) at some x, its tangent replaces it: df = base + rate dx. It
// must be asked again where that is not accurate enough. With F = k d^n a change of d by dx changes
// F by (n - 1) / (2 n) c^2 / f more than the tangent says, c = t dx. A dashpot that grows with
// d^(1/4) has at most 3/2 of that. The bound here is 4 c^2 / f, with the absolute values of both
// parts of t, as they may cancel where a law pulls.
#ifndef JOSTLE_LINK_TERMS_H
#define JOSTLE_LINK_TERMS_H

#include <float.h>
#include <math.h>

#include "core/lanes.h"
#include "core/number.h"
#include "solve/floors/floor_terms.h"

// LINKS_IN_LANES is defined for runs in lanes, after ensemble_contacts.h has been included.
#ifdef LINKS_IN_LANES
typedef wide link_number;
#define LINK_INLINE LANES_WHOLE_INLINE
#define LINK_SCHEME struct ensemble_factors
#define LINK_TANGENT struct tangent_lanes
#define ABSOLUTE(x) WIDE_ABSOLUTE(x)
#define SMALLER(a, b) WIDE_SMALLER(a, b)
#define AT_MOST(a, b) WIDE_AT_MOST(a, b)
#define AND &
#define OR |

LINK_INLINE void link_root(link_number *x) {
    for (int lane = 0; lane < WIDE_RUNS; lane++) {
        (*x)[lane] = sqrt((*x)[lane]);
    }
}
#else
#include "solve/contact/sweep.h"

typedef double link_number;
#define LINK_INLINE LANES_INLINE
#define LINK_SCHEME struct work
#define LINK_TANGENT struct tangent
#define ABSOLUTE(x) fabs(x)
#define SMALLER(a, b) number_min(a, b)
#define AT_MOST(a, b) ((a) <= (b))
#define AND &&
#define OR ||

LINK_INLINE void link_root(link_number *x) {
    *x = sqrt(*x);
}
#endif

// A Newton step is safe if it changes force and penetration by no more than this share, and if the
// slope of the law times the flexibility of the link, S_ll t, is no more than this.
static const double LINK_NEAR = 0.1;
static const double LINK_STEEPEST = 0.1;

// Changes below this share of `enough` are not made.
static const double LINK_NEGLECTED = 0.1;

// A force f may follow the slope of its law by a change c as long as 4 c^2 / f does not matter.
static const double LINK_STRAIGHT = 0.1 / 4.0;

// What was settled to a tolerance looser by this factor still is.
static const double LINK_LOOSER = 4.0;

// A first guess: the polynomial through the force f of the last step and those before.
#define CUBIC_GUESS(f, past) (4.0 * ((f) + (past)[1]) - 6.0 * (past)[0] - (past)[2])
#define PARABOLIC_GUESS(f, past) (3.0 * ((f) - (past)[0]) + (past)[1])
#define LINEAR_GUESS(f, past) (2.0 * (f) - (past)[0])

// t of a law that says dF/dd and dF/dv, and whether S_ll t lets a Newton step start there.
#define SLOPE(w, law) ((w)->b * (law)->dfdd + (w)->g * (law)->dfdv)
#define IS_SHALLOW(share) (AT_MOST(0.0, share) AND AT_MOST(share, LINK_STEEPEST))

// A law that has been asked for the force of a link.
struct link_asked {
    link_number x, v, near;  // where, and how far in x a step may lead from there
    link_number f, enough;   // the force of the link, and a change of it that does not matter
    link_number force, dfdd, dfdv;  // what the law said
};

// Its tangent, where S_ll t is `share`. A law that is not `smooth` is asked at each step: no reach.
LINK_INLINE void link_linearise(const LINK_SCHEME *w, const struct link_asked *law,
                                const link_number *share, bool smooth, LINK_TANGENT *t) {
    const link_number steepness = ABSOLUTE(w->b * law->dfdd) + ABSOLUTE(w->g * law->dfdv) + DBL_MIN;
    const link_number inverse = 1.0 / ((1.0 + *share) * steepness);  // one division for both
    t->asked = law->x;
    t->near = law->near;
    t->damped = inverse * steepness;
    t->rate = SLOPE(w, law) * t->damped;
    t->base = (law->force - law->f) * t->damped;
    link_number bend = LINK_STRAIGHT * law->enough * ABSOLUTE(law->force);
    link_root(&bend);
    const link_number straight = bend * inverse * (1.0 + *share);
    const link_number turn = ABSOLUTE(law->v) * w->per_g;
    const link_number nearer = SMALLER(law->near, turn);
    const link_number all = SMALLER(nearer, straight), none = -1.0 - (link_number){0.0};
    t->reach = smooth ? all : none;
}

// Does a tangent hold at dx from where it begins?
#define IS_ON_TANGENT(t, dx) (AT_MOST(ABSOLUTE(dx), (t)->reach) OR AT_MOST(ABSOLUTE(dx), 0.0))

// The change of force that it asks for there, and whether that does not matter.
#define CHANGE(t, dx) ((t)->base + (t)->rate * (dx))
#define IS_IDLE(t, dx, df, enough)                                                                 \
    (AT_MOST(ABSOLUTE(df), LINK_NEGLECTED * (enough)) AND AT_MOST(ABSOLUTE(dx), (t)->reach))

// How far from there the change df leads, and whether it is safe for a force f.
#define LED(dx, flexibility, df) ABSOLUTE((dx) - (flexibility) * (df))
#define IS_SAFE(t, led, df, f)                                                                     \
    (AT_MOST(led, (t)->near) AND AT_MOST(ABSOLUTE(df), LINK_NEAR * ABSOLUTE(f)))

// The most that the rounding of d and v, of these sizes, makes of a change of the force.
#define ROUNDING(damped, dfdd, d, dfdv, v)                                                         \
    (4.0 * DBL_EPSILON * (ABSOLUTE(dfdd) * (d) + ABSOLUTE(dfdv) * (v)) * (damped))

// After a sweep with progress s, would another one change no force by more than the tolerance?
// Changes of forces on their tangents count by the share `echo` that comes back from the other
// links.
#define IS_SETTLED(s, echo, tolerance)                                                             \
    (AT_MOST((s)->moved[LAW_UNKNOWN], tolerance)                                                   \
         AND AT_MOST((echo) * (s)->moved[LAW_KNOWN], tolerance))

// Was the largest force by which the sweep measured changes not much larger than that now?
#define IS_MEASURED(enough, tolerance) AT_MOST(enough, LINK_LOOSER *(tolerance))

#endif
