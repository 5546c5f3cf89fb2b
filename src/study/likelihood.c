// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/likelihood.h"

#include <gsl/gsl_sf_erf.h>

enum { ITERATIONS_MAX = 200 };

double likelihood_hazard_slope(double x) {
    const double h = gsl_sf_hazard(x);
    return h * (h - x);
}

static int iterate(gsl_multiroot_fdfsolver *solver, gsl_multiroot_function_fdf *f, double residual,
                   double *x) {
    const gsl_vector_view start = gsl_vector_view_array(x, 2);
    int status = gsl_multiroot_fdfsolver_set(solver, f, &start.vector);
    int test = GSL_CONTINUE;
    for (int i = 0; i < ITERATIONS_MAX && status == GSL_SUCCESS && test == GSL_CONTINUE; i++) {
        status = gsl_multiroot_fdfsolver_iterate(solver);
        test = gsl_multiroot_test_residual(solver->f, residual);
    }
    x[0] = gsl_vector_get(solver->x, 0);
    x[1] = gsl_vector_get(solver->x, 1);
    return test;
}

int likelihood_solve(gsl_multiroot_function_fdf *f, double residual, double *x, struct error *e) {
    gsl_multiroot_fdfsolver *solver =
        gsl_multiroot_fdfsolver_alloc(gsl_multiroot_fdfsolver_gnewton, 2);
    if (!solver) {
        return error_no_memory(e);
    }
    const int status = iterate(solver, f, residual, x);
    gsl_multiroot_fdfsolver_free(solver);
    return status == GSL_SUCCESS
               ? STATUS_OK
               : error_set(e, STATUS_FAILED, "the fragility curve does not converge: %s",
                           gsl_strerror(status));
}
