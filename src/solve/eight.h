// SPDX-License-Identifier: GPL-3.0-or-later
// Tridiagonal solves of up to eight buildings of the same height in lanes.
#ifndef JOSTLE_EIGHT_H
#define JOSTLE_EIGHT_H

#include "solve/effective.h"

// q = A^-1 r for the buildings that are solved together from e[0] on, whose floors stand one behind
// the other in r and q, with the bits of solves one after the other.
void eight_solve(const struct effective *e, const double *r, double *q);

#endif
