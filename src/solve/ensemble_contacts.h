// SPDX-License-Identifier: GPL-3.0-or-later
// Contact forces of several runs at once, a run a lane.
#ifndef JOSTLE_ENSEMBLE_CONTACTS_H
#define JOSTLE_ENSEMBLE_CONTACTS_H

#include "solve/ensemble_lanes.h"

// Solves for the forces of the live contacts of `runs`, a bit each, of which `run` has all, as
// contact_solve does for a run alone; takes them into the runs and e->correction. Returns the runs
// that are solved: nothing has changed for the others.
unsigned ensemble_contacts_solve(struct ensemble_lanes *e, struct run *const *run, unsigned runs);

#endif
