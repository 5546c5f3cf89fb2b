// SPDX-License-Identifier: GPL-3.0-or-later
// A single step of Newmark's method inside a test: the states at both its ends, for the test to
// fill and to read, and all that newmark_step needs. Whatever goes wrong fails the test.
#ifndef JOSTLE_TEST_SINGLE_STEP_H
#define JOSTLE_TEST_SINGLE_STEP_H

#include "solve/newmark/newmark.h"

struct single_step {
    struct model *model;
    struct arena *arena;
    struct state now, next;
    struct work work;
    struct results results;
    struct energy_account energy;
    struct memory memory;
};

// Prepares steps of a model, which is given to `s` and may not be rejected. `s` must stay where it
// is until single_step_free.
void single_step_init(struct single_step *s, struct model *m);
void single_step_free(struct single_step *s);

// Takes a step of size h from s->now, at t = 0, to s->next.
void single_step_take(struct single_step *s, double h);

#endif
