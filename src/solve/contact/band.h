// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems whose matrix is 0 but for a band along its diagonal.
#ifndef JOSTLE_BAND_H
#define JOSTLE_BAND_H

#include <stdbool.h>
#include <stddef.h>

// Solves A x = b for the matrix A (n, n), rows after each other, in place of b (n). A is 0 farther
// than `width` from its diagonal; entries farther than three times that are not read. What is left
// of A means nothing. False: A is singular, or not finite.
bool band_solve(double *a, double *b, ptrdiff_t n, ptrdiff_t width);

#endif
