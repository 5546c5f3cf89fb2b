// SPDX-License-Identifier: GPL-3.0-or-later
// Tridiagonal solves of four buildings of the same height in lanes.
#ifndef JOSTLE_FOUR_H
#define JOSTLE_FOUR_H

#include "solve/effective.h"

// q = A^-1 r for four buildings of e[0].building->n_floor floors, with the bits of four
// solves one after the other.
void four_solve(const struct effective e[4], double *const r[4], double *const q[4]);

#endif
