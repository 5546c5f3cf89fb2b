// SPDX-License-Identifier: GPL-3.0-or-later
// The methods by which the time loop goes from row to row of the output.
#ifndef JOSTLE_METHOD_H
#define JOSTLE_METHOD_H

#include "solve/run.h"

struct method {
    // The models that are integrated by it.
    enum integrator integrator;
    bool adaptive;

    // What it carries from step to step, of struct run.
    const struct fields *fields;

    // Room for what it needs of the run; false: no memory.
    bool (*alloc)(struct run *r, struct arena *a);

    // Begins at r->now, the state at t = 0; NULL: nothing to do.
    void (*start)(struct run *r);

    // Goes from step *n of the model to a later one, `end` at most, and makes r->now its state.
    // Quantities that only rows show may be left out before `end`.
    int (*advance)(struct run *r, long *n, long end);

    // Computes what rows show of r->now and brings r->energy up to it; NULL: advance has done so.
    void (*complete)(struct run *r);

    // Makes its scratch that of the fields, which have been replaced; NULL: nothing to do.
    void (*resume)(struct run *r);
};

// The method for a model.
const struct method *method_of(const struct model *m);

#define METHOD(descriptor) extern const struct method descriptor;
#include "solve/method_list.inc"
#undef METHOD

#endif
