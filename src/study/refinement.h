// SPDX-License-Identifier: GPL-3.0-or-later
// The same model at ever shorter steps, and what becomes of its results.
#ifndef JOSTLE_REFINEMENT_H
#define JOSTLE_REFINEMENT_H

#include "jostle/analysis.h"
#include "study/convergence.h"

enum refined_owner { OF_MODEL, OF_BUILDING, OF_LINK };

// One result.
struct refined {
    enum refined_owner owner;
    int index;                          // of the building or link
    const char *quantity;               // "roof displacement"
    const struct dimension *dimension;  // NULL: a count of impacts
    double *value;                      // (n_level)
    struct convergence convergence;
    bool within;          // the tolerance
    bool impacts_change;  // with the last step: of the contact, or of a contact of the building
};

struct refinement {
    struct arena *arena;  // owns what is below
    int n_level;
    double *step;  // [T] (n_level); of adaptive steps the tolerance
    long *steps;   // (n_level) computed
    int n_result, n_within;
    struct refined *result;  // (n_result) of the model, of its buildings, of its links
};

// Runs the model n_level times, from its own step to the shortest, and judges the results against
// the relative tolerance. `observer` NULL: nobody looks on; its time begins anew at each level.
// Errors: those of analysis_run. *out must be given to refinement_free.
int refinement_run(const struct model *m, int n_level, double rtol, const struct observer *observer,
                   struct refinement **out, struct error *e);
void refinement_free(struct refinement *r);  // NULL is allowed

#endif
