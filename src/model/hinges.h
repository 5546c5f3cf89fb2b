// SPDX-License-Identifier: GPL-3.0-or-later
// Hinges of a frame: laws of moment and rotation at the ends of its members, in series with them.
//
// The rotation of a hinge is what the end of the member turns more than its joint, counterclockwise
// positive. Its moment m = law(rotation) acts on the joint, and -m on the end of the member.
//
// The frame is elastic but for its hinges, so its joints are condensed: with S of struct
// plane_frame, unit drifts and unit rotations of hinges give storey shears V and moments on ends.
//     V = S_dd d + S_dr r,   S_rd d + S_rr r + law(r) = 0,
// and the rotations r of the hinges are the only unknowns of the part.
#ifndef JOSTLE_HINGES_H
#define JOSTLE_HINGES_H

#include <stddef.h>

#include "core/arena.h"
#include "jostle/error.h"
#include "jostle/model.h"
#include "model/frame.h"

struct hinge {
    int member, end;       // 0: end i, 1: end j
    double stiffness;      // [F L] initial
    struct storey storey;  // its law of moment and rotation; history: offset behind the values that
                           // hinges have of their own
};

// Prepares the hinges of the condensed frame, which have laws but no histories yet. STATUS_SYSTEM:
// no memory; STATUS_INPUT: a matrix is not finite.
int hinges_create(struct plane_frame *f, const struct hinge *hinge, struct arena *a,
                  struct error *e);

// The values that the history and the scratch of the part have. The history begins with the
// rotations of all n hinges and the departures of their moments from their initial lines; the
// histories of the laws are behind these.
int hinges_n_history(const struct hinges *h);
int hinges_n_scratch(const struct hinges *h);
static inline ptrdiff_t hinges_of_laws(int n) {
    return 2 * (ptrdiff_t)n;
}

// The rows of a quantity that is linear in drifts and rotations of hinges, on drifts and departures
// instead (n_action): a departure from the initial line stays when a hinge unloads on that line.
void hinges_on_departures(const struct plane_frame *f, const double *row, double *out);

// What kind of part a frame with these hinges is.
const struct part_kind *hinges_kind(const struct hinges *h);

// The hinge `i` of the frame.
const struct hinge *hinges_at(const struct plane_frame *f, int i);

#endif
