// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a building's resistance beside its shear storeys, all together (jostle/part.h).
#ifndef JOSTLE_PARTS_H
#define JOSTLE_PARTS_H

#include "jostle/model.h"

// Adds the shears and tangents of all parts of building `g` at these drifts and drift rates
// (n_dof). `history` is the storey history of a state. `after` is the storey history of the next
// state, or NULL (struct part_kind). The function does not read the rates of an elastic building.
void parts_respond(const struct building *g, const double *history, const double *drift,
                   const double *rate, const struct part_sums *to, double *after);

// Are the tangents of all parts of building `g` diagonal?
bool parts_are_diagonal(const struct building *g);

// Where the diagonal entry i of matrices (n, n) is.
static inline size_t parts_diagonal(const struct part_sums *to, int n, int i) {
    return to->diagonal ? (size_t)i : (size_t)i * (size_t)n + (size_t)i;
}

// The initial tangents of the parts of building `g` by drifts and then by rates, into `to`: the
// diagonals (n_dof) if the building has no full matrices, else (n_dof, n_dof) each.
void parts_initial(const struct building *g, double *to);

// Recoverable energy of the parts of building `g` [F L].
double parts_stored(const struct building *g, const double *history, const double *drift);

// Work of the viscous forces of the parts of building `g` since the start [F L].
double parts_damped(const struct building *g, const double *history);

// The functions of a linear part, whose shears are its stiffness times the drifts; of other parts,
// what is linear in them.
void parts_linear_respond(const struct part *p, const double *history, const double *drift,
                          const double *rate, const struct part_sums *to, double *after);
double parts_linear_stored(const struct part *p, const double *history, const double *drift);

// Entry (i, j) of the matrix on floor displacements, from a matrix on drifts (n, n).
static inline double parts_on_floors(const double *on_drifts, int n, int i, int j) {
    const double *x = on_drifts + (size_t)i * (size_t)n + (size_t)j;
    const bool above = i + 1 < n, beside = j + 1 < n;
    return x[0] - (above ? x[n] : 0.0) - (beside ? x[1] : 0.0) + (above && beside ? x[n + 1] : 0.0);
}

#endif
