// SPDX-License-Identifier: GPL-3.0-or-later
// The methods by which the time loop goes from row to row of the output.
#ifndef JOSTLE_METHOD_H
#define JOSTLE_METHOD_H

#include "solve/run.h"

struct method {
    // The models that are integrated by it.
    enum integrator integrator;
    bool adaptive;

    // Room for what it needs of the run; false: no memory.
    bool (*alloc)(struct run *r, struct arena *a);

    // Begins at r->now, the state at t = 0; NULL: nothing to do.
    void (*start)(struct run *r);

    // Goes from step *n of the model to a later one, `end` at most, and makes r->now its state.
    // What is shown of it need be made for `end` only.
    int (*advance)(struct run *r, long *n, long end);

    // Makes what is shown of r->now, and r->energy up to it; NULL: they are right after advance.
    void (*complete)(struct run *r);

    // Adds to the results what is known at the end of a run only; NULL: nothing is.
    void (*finish)(struct run *r);
};

// The method for a model.
const struct method *method_of(const struct model *m);

#define METHOD(descriptor) extern const struct method descriptor;
#include "solve/method_list.inc"
#undef METHOD

#endif
