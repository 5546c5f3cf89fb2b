// SPDX-License-Identifier: GPL-3.0-or-later
// Quick sweeps over the contacts of runs in lockstep.
#ifndef JOSTLE_ENSEMBLE_SWEEPS_H
#define JOSTLE_ENSEMBLE_SWEEPS_H

#include "solve/ensemble_lanes.h"

// Contacts that live in some run, and sweeps: contact.c does other things after these.
enum { ENSEMBLE_JOINTS = 8, ENSEMBLE_SWEEPS = 4 };

// A contact that is live in some of the runs; names as in struct quick.
struct joint {
    wide force, base, rate, asked, reach, near, damped;
    wide d_trial, v_trial, dfdd, dfdv;
    wide fits_to;
    wide_bits live, ask;
    const struct ensemble_grip *grip;
    int contact;
    unsigned runs;  // in which it is live
};

// As struct progress, and what runs have in common.
struct sweeps {
    struct joint joint[ENSEMBLE_JOINTS];  // in ascending order
    wide tolerance, enough, loosest, largest, change, moved, echo, clear;
    wide_bits alone;  // only one contact is live
    wide_bits well;   // the lane has not given up,
    wide_bits busy;   // nor converged
    wide_bits count;  // of sweeps
    double per_b, per_g;
    struct ensemble_lanes *e;
    int n_joint;
    int n_touched, touched[2 * ENSEMBLE_JOINTS];  // buildings
};

// Solves for the forces of the joints in the lanes of `runs`, from those given. s->well says in
// which lanes it has, and e->correction has changed.
void ensemble_sweeps(struct sweeps *s, unsigned runs);

#endif
