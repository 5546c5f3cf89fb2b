// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the rotations of the hinges of a frame (model/hinges.h), in scratch.
#ifndef JOSTLE_HINGE_SEARCH_H
#define JOSTLE_HINGE_SEARCH_H

#include "model/hinges.h"

struct hinges {
    int n, n_floor;
    int stride;  // n in whole lanes
    int n_history;
    const struct hinge *hinge;  // (n)
    double *by_drift;           // [1/L] (n_floor, stride) P, transposed
    double *by_moment;          // [1/(F L)] (n, stride) B
    double *initial;  // [F/L] (n_floor, n_floor) of the frame with its hinges on their first lines
};

// Rotations and the laws there.
struct hinge_point {
    double *turn;       // (n) rotations
    double *departure;  // [F L] (n) s
    double *softening;  // [F L] (n) e
    double *unbalance;  // [F L] (n) u
    double size;        // [F L] the largest moment of which unbalanced moments are the rounding
};

// The search for the rotations, in scratch.
struct hinge_search {
    const struct hinges *h;
    const double *departure;  // [F L] (n) committed
    const double *history;    // of the laws
    double *after;            // of the laws; NULL: not asked for
    struct hinge_point at, trial;
    double *step;     // (n) dr
    double *push;     // [F L] (n) y, and 0 outside the set A
    double *inverse;  // (n) of pivots
    double *factor;   // (n, n) row j: entries from j on
    double *right;    // (n, n_floor)
    int *order;       // (n) numbers of the hinges of set A
    int n_active;
};

// Numbers of the scratch.
int hinge_search_n_scratch(const struct hinges *h);

// A search from this history of the part; `after`, unless it is NULL, gets that of the laws.
struct hinge_search hinge_search_begin(const struct hinges *h, const double *history, double *after,
                                       double *scratch);

// Finds the rotations at these drifts; false: they are not found.
bool hinge_search_find(struct hinge_search *x, const double *drift);

// Takes the laws at the rotations of a point.
void hinge_search_laws(const struct hinge_search *x, struct hinge_point *p);

// Adds the storey shears at these drifts with the rotations found, and the consistent tangent.
// False: there is none.
void hinge_search_add_shear(const struct hinge_search *x, const double *drift, double *shear);
bool hinge_search_add_tangent(struct hinge_search *x, double *by_drift);

#endif
