// SPDX-License-Identifier: GPL-3.0-or-later
// One step of Newmark's method.
#ifndef JOSTLE_NEWMARK_H
#define JOSTLE_NEWMARK_H

#include "solve/work.h"

// Takes the committed state `now` over a step of size h to `next`, whose time is `end`. `now` is
// not touched. Internal forces of linear models are left to floors_account. STATUS_RETRY: not
// solved, `next` is meaningless. STATUS_FAILED: the state is not finite. The accounts of `w`
// (floors_account_to) must be set.
int newmark_step(struct work *w, const struct state *now, struct state *next, double end, double h,
                 struct error *e);

#endif
