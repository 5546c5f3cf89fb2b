// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/root.h"

#include <assert.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

enum { ITERATIONS_MAX = 200 };

double root_find(double (*function)(double x, void *context), void *context, double low,
                 double high, double tolerance) {
    assert(function && tolerance > 0.0);
    gsl_function f = {.function = function, .params = context};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (!solver) {
        return NAN;
    }
    int status = gsl_root_fsolver_set(solver, &f, low, high);
    double root = NAN;
    for (int i = 0; status == GSL_SUCCESS && i < ITERATIONS_MAX; i++) {
        status = gsl_root_fsolver_iterate(solver);
        root = status == GSL_SUCCESS ? gsl_root_fsolver_root(solver) : NAN;
        if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                   gsl_root_fsolver_x_upper(solver), 0.0,
                                   tolerance) == GSL_SUCCESS) {
            break;
        }
    }
    gsl_root_fsolver_free(solver);
    return root;
}
