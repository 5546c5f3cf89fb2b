// SPDX-License-Identifier: GPL-3.0-or-later
// The exact answer of one link in the contact iteration, with the forces of all others held.
#ifndef JOSTLE_ANSWER_H
#define JOSTLE_ANSWER_H

#include "solve/contact/sweep.h"

// The equation of link k at the trial state of `next`.
struct line answer_line(const struct work *w, const struct state *now, const struct state *next,
                        int k);

// Gives link k its exact answer; returns the change of its force.
double answer_link(struct work *w, const struct state *now, struct state *next, int k);

// The same in a sweep, with what that records. Newton steps may follow where the law leaves no
// choice of branch.
void answer_exactly(struct work *w, const struct state *now, struct state *next,
                    struct link_scratch *p, struct progress *progress);

// Rounding error that the forces of other links cause in x (n_dof).
double answer_rounding(const struct work *w, const double *x);

#endif
