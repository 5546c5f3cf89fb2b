// SPDX-License-Identifier: GPL-3.0-or-later
// The exact force of one link while those of all others are held. Under Newmark its penetration and
// velocity at the end of a step are straight lines over its own force, which leaves one equation in
// one unknown.
#ifndef JOSTLE_EXACT_H
#define JOSTLE_EXACT_H

#include "solve/contact/sweep.h"

// d = d_free - d_force f and v = v_free - v_force f.
struct equation {
    const struct link *link;
    const double *history;      // of the link, at the start of the step or at its closure
    double d_free, v_free;      // [L] [L/T] if its force were zero
    double d_force, v_force;    // [L/F] [L/T/F] both >= 0
    double v_rest, v_rounding;  // [L/T] of a rigid contact: the velocity it must end with, and
                                // the rounding error of that
    bool closed;                // in contact at the start of the step
    bool clamped;               // its law may pull, but is not allowed to
    bool held;                  // stays closed whatever d is: the step ends where it opens
};

// The equation of link k at the trial state of `next`.
struct equation exact_equation(const struct work *w, const struct state *now,
                               const struct state *next, int k);

// The force of the link. A closed link stays closed as long as a closed solution exists; an open
// one stays open as long as an open one does. `guess` starts the search. Cannot fail: where the law
// is not monotone (it pulls) the solution found from the guess is taken.
enum branch exact_force(const struct equation *e, double guess, double *force);

// By how much `force` exceeds the force that would have to move the link for its law to give just
// `force` there.
double exact_excess(const struct equation *e, double force);

// The force of the law and its tangents at the state that `force` leads to, and the slope of the
// law over the force, with its sign changed.
struct contact_response exact_law(const struct equation *e, double force);
static inline double exact_slope(const struct equation *e, const struct contact_response *law) {
    return e->d_force * law->dfdd + e->v_force * law->dfdv;
}

// Gives link k its exact force; returns the change of it.
double exact_solve(struct work *w, const struct state *now, struct state *next, int k);

// The same in a sweep, with what that records. Newton steps may follow where the law leaves no
// choice of branch.
void exact_visit(struct work *w, const struct state *now, struct state *next,
                 struct link_scratch *p, struct progress *progress);

#endif
