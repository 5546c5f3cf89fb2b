// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/least_squares.h"

#include <assert.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>
#include <stdlib.h>

const double least_squares_origin = 1.0;

static const double TOLERANCE = 1e-10;  // of the unknowns, and of the gradient
static const double DIFFERENCE = 1e-6;  // of central differences; impacts have errors of 1e-12
static const double STATIONARY = 1e-6;  // largest cosine between residuals and a derivative
static const double EXACT = 1e-9;       // share of the scale: residuals below are rounding errors
enum { ITERATIONS_MAX = 200 };

struct least_squares_memory {
    gsl_multifit_nlinear_workspace *work;
    gsl_matrix *covariance;
    double *value;  // (n)
};

int least_squares_open(struct least_squares *l, struct error *e) {
    assert(l->n_unknown > 0 && l->n_unknown <= LEAST_SQUARES_UNKNOWNS);
    const size_t p = (size_t)l->n_unknown;
    const gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    struct least_squares_memory *m = calloc(1, sizeof *m);
    l->memory = m;
    if (m) {
        m->work = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, l->n, p);
        m->covariance = gsl_matrix_alloc(p, p);
        m->value = calloc(l->n, sizeof *m->value);
    }
    return m && m->work && m->covariance && m->value ? STATUS_OK : error_no_memory(e);
}

void least_squares_close(struct least_squares *l) {
    struct least_squares_memory *m = l->memory;
    if (m && m->work) {
        gsl_multifit_nlinear_free(m->work);
    }
    if (m && m->covariance) {
        gsl_matrix_free(m->covariance);
    }
    if (m) {
        free(m->value);
    }
    free(m);
    l->memory = NULL;
}

static void unknowns(const struct least_squares *l, const gsl_vector *x, double *out) {
    for (int u = 0; u < l->n_unknown; u++) {
        out[u] = gsl_vector_get(x, (size_t)u);
    }
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *r) {
    struct least_squares *l = context;
    double at[LEAST_SQUARES_UNKNOWNS];
    unknowns(l, x, at);
    l->predict(l->context, at, l->memory->value);
    for (size_t i = 0; i < l->n; i++) {
        gsl_vector_set(r, i, (l->memory->value[i] - l->measured[i]) / l->scale);
    }
    return GSL_SUCCESS;
}

// Column `u` of the derivatives by central differences.
static void difference(struct least_squares *l, const double *x, int u, gsl_vector *column) {
    double moved[LEAST_SQUARES_UNKNOWNS];
    for (int i = 0; i < l->n_unknown; i++) {
        moved[i] = x[i];
    }
    gsl_vector_set_zero(column);
    for (int side = -1; side <= 1; side += 2) {
        moved[u] = x[u] + side * DIFFERENCE;
        l->predict(l->context, moved, l->memory->value);
        gsl_vector_const_view value = gsl_vector_const_view_array(l->memory->value, l->n);
        gsl_blas_daxpy(side / (2.0 * DIFFERENCE * l->scale), &value.vector, column);
    }
}

static int derivatives(const gsl_vector *x, void *context, gsl_matrix *derivative) {
    struct least_squares *l = context;
    double at[LEAST_SQUARES_UNKNOWNS];
    unknowns(l, x, at);
    for (int u = 0; u < l->n_unknown; u++) {
        gsl_vector_view column = gsl_matrix_column(derivative, (size_t)u);
        if (!l->derivative || !l->derivative(l->context, at, u, l->memory->value)) {
            difference(l, at, u, &column.vector);
            continue;
        }
        for (size_t i = 0; i < l->n; i++) {
            gsl_vector_set(&column.vector, i, l->memory->value[i] / l->scale);
        }
    }
    return GSL_SUCCESS;
}

// True if no change of the unknowns makes the residuals smaller: they are orthogonal to all
// derivatives, or rounding.
static bool is_stationary(const struct least_squares *l) {
    const gsl_vector *residual = gsl_multifit_nlinear_residual(l->memory->work);
    const gsl_matrix *derivative = gsl_multifit_nlinear_jac(l->memory->work);
    const double norm = gsl_blas_dnrm2(residual);
    if (norm <= EXACT * sqrt((double)l->n)) {
        return true;
    }
    for (int u = 0; u < l->n_unknown; u++) {
        gsl_vector_const_view column = gsl_matrix_const_column(derivative, (size_t)u);
        double product;
        gsl_blas_ddot(&column.vector, residual, &product);
        if (!(fabs(product) <= STATIONARY * gsl_blas_dnrm2(&column.vector) * norm)) {
            return false;
        }
    }
    return true;
}

static double normalised_error(const struct least_squares *l) {
    gsl_vector_const_view measured = gsl_vector_const_view_array(l->measured, l->n);
    return gsl_blas_dnrm2(gsl_multifit_nlinear_residual(l->memory->work)) * l->scale /
           gsl_blas_dnrm2(&measured.vector);
}

int least_squares_search(struct least_squares *l, struct least_squares_result *out,
                         struct error *e) {
    struct least_squares_memory *m = l->memory;
    double first[LEAST_SQUARES_UNKNOWNS];
    for (int u = 0; u < l->n_unknown; u++) {
        first[u] = least_squares_origin;
    }
    gsl_vector_const_view x = gsl_vector_const_view_array(first, (size_t)l->n_unknown);
    gsl_multifit_nlinear_fdf system = {
        .f = residuals, .df = derivatives, .n = l->n, .p = (size_t)l->n_unknown, .params = l};
    int info;
    int status = gsl_multifit_nlinear_init(&x.vector, &system, m->work);
    if (status == GSL_SUCCESS) {
        status = gsl_multifit_nlinear_driver(ITERATIONS_MAX, TOLERANCE, TOLERANCE, 0.0, NULL, NULL,
                                             &info, m->work);
    }
    if (status != GSL_SUCCESS && !is_stationary(l)) {
        return error_set(e, STATUS_FAILED,
                         "the fit of %s does not converge: the normalised error is %.3g %% after "
                         "%zu iterations",
                         l->name, 100.0 * normalised_error(l), gsl_multifit_nlinear_niter(m->work));
    }
    const double degrees = (double)l->n - l->n_unknown;
    const double sigma = gsl_blas_dnrm2(gsl_multifit_nlinear_residual(m->work)) / sqrt(degrees);
    unknowns(l, gsl_multifit_nlinear_position(m->work), out->x);
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(m->work), 0.0, m->covariance);
    for (int u = 0; u < l->n_unknown; u++) {
        out->error[u] = sigma * sqrt(gsl_matrix_get(m->covariance, (size_t)u, (size_t)u));
    }
    out->normalised_error = normalised_error(l);
    return STATUS_OK;
}
