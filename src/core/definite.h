// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric matrices without negative eigenvalues.
#ifndef JOSTLE_DEFINITE_H
#define JOSTLE_DEFINITE_H

// Replaces the negative eigenvalues of the symmetric matrix k (n, n) by 0. A matrix that has none,
// but for rounding, keeps its bits. `scratch` (2 n n).
void definite_clip(double *k, int n, double *scratch);

#endif
