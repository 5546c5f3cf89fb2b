// SPDX-License-Identifier: GPL-3.0-or-later
// The links of a run whose floors are in a lane but whose links are not. A step in which some act
// is taken by all floors at once, and then by the links of each such run as if it were alone. In
// struct run only the arrays of links, and what they need of their floors, are up to date
// meanwhile.
#ifndef JOSTLE_ENSEMBLE_LINKS_H
#define JOSTLE_ENSEMBLE_LINKS_H

#include "solve/ensemble/ensemble_lanes.h"

// Lets a run whose links have been taken out of the lane know what they feel of their floors.
void ensemble_links_recall(const struct ensemble_lanes *e, int lane, const struct run *r);

// Begins the step from time `start` to `end` for a run with live links, or with a contact that is
// pressed in it: links that were closed act.
void ensemble_links_begin(struct ensemble_lanes *e, int lane, struct run *r, double start,
                          double end);

// The lanes begin it with their forces.
void ensemble_links_push(struct ensemble_lanes *e, int lane, const struct run *r);

// Closes pressed contacts of the lane where they do close; returns how many.
int ensemble_links_close(struct ensemble_lanes *e, int lane, struct run *r);

// Solves for the forces of live links, which push their buildings in the lane.
// STATUS_RETRY: the run has to take this step alone.
int ensemble_links_solve(struct ensemble_lanes *e, int lane, struct run *r);

// Ends a step that is solved, when the lane has taken over what links have done. STATUS_RETRY: a
// force has jumped in it, as above.
int ensemble_links_finish(const struct ensemble_lanes *e, int lane, struct run *r);

// Takes it into the account of the run and commits it, before the lane does. Errors: STATUS_SYSTEM.
int ensemble_links_commit(struct ensemble_lanes *e, int lane, struct run *r);

// Forgets which contacts have acted in the lane.
void ensemble_links_release(struct ensemble_lanes *e, int lane, const struct run *r);

#endif
