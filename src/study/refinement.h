// SPDX-License-Identifier: GPL-3.0-or-later
// The same model at ever shorter steps, and what becomes of its results.
#ifndef JOSTLE_REFINEMENT_H
#define JOSTLE_REFINEMENT_H

#include "jostle/analysis.h"

enum { CONVERGENCE_LEVELS_MIN = 3, CONVERGENCE_LEVELS_MAX = 16 };

enum convergence_kind {
    CONVERGENCE_NONE,       // nothing changes beyond rounding
    CONVERGENCE_ORDERLY,    // towards a limit, at an order that can be believed
    CONVERGENCE_FAST,       // towards a limit faster than the method can: partly by chance
    CONVERGENCE_IRREGULAR,  // back and forth, or by growing differences
    CONVERGENCE_COUNT,      // whole numbers, the last two equal
    CONVERGENCE_MISCOUNT,   // whole numbers, the last two different
};

struct convergence {
    enum convergence_kind kind;
    double order;     // observed; NAN: there is none
    double estimate;  // of the limit: by Richardson, or the value at the shortest step
    double error;     // half the width of the error bar at the shortest step
};

// Of the last three of n >= 3 values at steps h, h / ratio, h / ratio^2 ..., ratio > 1, by a method
// of the given order. `safety`: the error bar over the error estimated at an order.
struct convergence refinement_convergence(const double *value, int n, double ratio, double order,
                                          double safety);

// Of a number of things, of which n >= 2 are given.
struct convergence refinement_convergence_of_count(const double *value, int n);

// Whether the error bar is within `rtol` of the value at the shortest step; a miscount is not.
// `value` is that one.
bool refinement_is_within(const struct convergence *c, double value, double rtol);

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
