// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies and mode shapes of a building alone, on its initial stiffness.
#ifndef JOSTLE_MODES_H
#define JOSTLE_MODES_H

#include "jostle/error.h"

// Solves K phi = omega^2 M phi for a building of n shear storeys with these stiffnesses, and of
// parts with the stiffness `parts` on drifts (n, n); NULL: no parts. omega (n) [1/T] ascending;
// shape (n, n): row m is mode m+1, normalised to phi^T M phi = 1. Allocates scratch only. Errors:
// STATUS_SYSTEM (no memory), STATUS_FAILED (the eigenvalues did not converge).
int modes_solve(int n, const double *mass, const double *stiffness, const double *parts,
                double *omega, double *shape, struct error *e);

// Scales each shape so that its entry of largest magnitude is 1.
void modes_scale_to_largest(int n, double *shape);

#endif
