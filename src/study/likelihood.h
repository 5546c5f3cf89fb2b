// SPDX-License-Identifier: GPL-3.0-or-later
// Largest likelihood of two parameters.
#ifndef JOSTLE_LIKELIHOOD_H
#define JOSTLE_LIKELIHOOD_H

#include <gsl/gsl_multiroots.h>

#include "jostle/error.h"

// Newton's method for the zero of the gradient that `f` computes with its Jacobian, from x[0],
// x[1], which become the solution: each part of the gradient is below `residual` there. Errors:
// STATUS_SYSTEM (no memory), STATUS_FAILED (the iteration does not converge).
int likelihood_solve(gsl_multiroot_function_fdf *f, double residual, double *x, struct error *e);

// The derivative h (h - x) of the hazard h(x) = phi(x) / Phi(-x), which gsl_sf_hazard computes.
double likelihood_hazard_slope(double x);

#endif
