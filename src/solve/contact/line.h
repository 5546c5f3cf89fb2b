// SPDX-License-Identifier: GPL-3.0-or-later
// One link with all others held: under Newmark its penetration and velocity at the end of a step
// are straight lines over its own force, which leaves one equation in one unknown.
#ifndef JOSTLE_LINE_H
#define JOSTLE_LINE_H

#include "jostle/model.h"

// d = d_free - d_force f and v = v_free - v_force f.
struct line {
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

// The state of a link at the end of a step.
enum branch {
    BRANCH_OPEN,    // force 0
    BRANCH_CLOSED,  // force of the law, d > 0
    BRANCH_JUMP,    // d = 0, the force within the jump of the law at closure, or of a rigid contact
    BRANCH_NONE,  // neither open nor closed: the opening lies inside the step; *force is the jump's
};

// The force of the link. A closed link stays closed as long as a closed solution exists; an open
// one stays open as long as an open one does. `guess` starts the search. Cannot fail: where the law
// is not monotone (it pulls) the solution found from the guess is taken.
enum branch line_answer(const struct line *l, double guess, double *force);

// By how much `force` exceeds the force that would have to move the link for its law to give just
// `force` there.
double line_excess(const struct line *l, double force);

// The force of the law and its tangents at the state that `force` leads to.
struct contact_response line_law(const struct line *l, double force);

#endif
