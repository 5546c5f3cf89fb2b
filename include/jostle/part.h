// SPDX-License-Identifier: GPL-3.0-or-later
// What a part of a building's resistance is, beside its shear storeys: a stiffness matrix, a frame,
// a wall. The storey shears of all parts add up. A part is data with one const descriptor, in the
// file of the statement that makes it.
//
// Parts work on the drifts of all storeys, d_i = u_i - u_(i-1). The storey shear V_i is the sum of
// the part's forces on floor i and all floors above it, so that its work is the sum of V_i dd_i.
// With K on floor displacements, the same stiffness on drifts is
//     D_ij = sum over k >= i, l >= j of K_kl.
#ifndef JOSTLE_PART_H
#define JOSTLE_PART_H

#include <stdbool.h>

#include "jostle/names.h"

JOSTLE_C_BEGIN

enum part_trait {
    PART_LINEAR = 1,     // the shears are one matrix times the drifts: no rates, no history
    PART_STRAIGHT = 2,   // they are so between corners: the tangent changes at these only
    PART_SHARELESS = 4,  // it is of the shear storeys: results show no share of its own
    PART_DIAGONAL = 8,   // it couples no storeys, unless another part of the building does: its
                         // tangents are diagonal
};

// What a part adds to. Matrices are symmetric to the bit. NULL: not needed.
struct part_sums {
    bool diagonal;     // the matrices are (n): their diagonals, as all parts are PART_DIAGONAL
    double *shear;     // [F] (n)
    double *by_drift;  // [F/L] (n, n) d shear / d drift; it may be negative
    double *by_rate;   // [F T/L] (n, n) d shear / d drift rate
    double *scratch;   // (n_scratch) of a part that has unknowns of its own
};

struct part {
    const struct part_kind *kind;
    const char *name;         // its own in the building, as the result file has it
    const char *source;       // what it was made from, for messages: a file, members
    int n;                    // storeys of its building
    const double *stiffness;  // [F/L] (n, n) on drifts, of all that is linear; NULL: nothing is
    const void *data;
    int n_history;
    int history;  // offset of its values in the state's storey history
    int n_scratch;
};

struct part_kind {
    const char *name;
    unsigned traits;  // enum part_trait

    // Adds the shears and their consistent tangents at these drifts and drift rates (n), from the
    // committed history, which is 0 at first. `after`, unless it is NULL, becomes the history that
    // a step which ends there commits; it may be `history` itself. Pure: any drifts that an
    // iteration may visit. The first shear, or else the first tangent, is NAN if the part has no
    // equilibrium there.
    void (*respond)(const struct part *p, const double *history, const double *drift,
                    const double *rate, const struct part_sums *to, double *after);

    // Recoverable energy at these drifts with the committed history [F L].
    double (*stored)(const struct part *p, const double *history, const double *drift);

    // Work of its viscous forces since the start [F L], which the account counts as damping. NULL:
    // none; what it does not store is hysteretic.
    double (*damped)(const struct part *p, const double *history);
};

JOSTLE_C_END

#endif
