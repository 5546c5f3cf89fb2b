// SPDX-License-Identifier: GPL-3.0-or-later
// What adaptive steps of Newmark's method, adaptive_newmark.c, remember from step to step.
#ifndef JOSTLE_STEP_LENGTH_H
#define JOSTLE_STEP_LENGTH_H

#include "solve/forcing.h"
#include "solve/pace.h"
#include "solve/scale.h"

struct step_length {
    struct forcing forcing;  // for its corners
    struct scales scales;    // of errors
    struct pace pace;
    double trial;             // [T] what the error control would take next
    double last;              // [T] the step to the present state; 0: its accelerations jump there
    double split;             // [T] when a step was last split at an event
    bool turned;              // the forcing has a corner at the present state
    double *before, *within;  // [L/T^2] (n_dof) accelerations at the start of the last step: all of
                              // them, and without what the forcing does directly
};

#endif
