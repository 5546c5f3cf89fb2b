// SPDX-License-Identifier: GPL-3.0-or-later
// What Newmark's method remembers from step to step besides its states. It is not physical, but the
// last bits of the results depend on it.
#ifndef JOSTLE_MEMORY_H
#define JOSTLE_MEMORY_H

#include "jostle/model.h"
#include "solve/fields.h"

// What has been found to be short enough for a contact.
struct resolved {
    double step;   // [T] with which the start or the end of a step was last resolved; 0: none
    double depth;  // [L] penetration up to which steps are short enough for its spring,
    long factors;  // work.factors with which that is so
};

struct memory {
    double *tangent;            // [F/L] (n_dof) of the storeys when they were last linearised
    struct resolved *resolved;  // (n_link)
    int unresolved;             // link that last needed a shorter step; -1: none did
};
extern const struct fields memory_fields;

// Room for the memory of a run that has taken no step; false: no memory.
bool memory_alloc(struct memory *s, const struct model *m, struct arena *a);

#endif
