// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares over the samples of a record,
//
//     sum over i of (F_i - F(t_i - t0; k, zeta))^2 = min.
//
// F is the force of an isolated impact and t0 the instant of closure. The method is the
// trust-region method of Levenberg and Marquardt (GSL). Jankowski (2005), Earthquake Eng. Struct.
// Dyn. 34, 595-611, fitted by hand. His normalised error is the square root of this sum over that
// of F = 0.
//
// The unknowns are the logarithms of k and zeta, which keeps both positive, and t0 over the
// duration of the impact. The derivative with respect to t0 follows from the law. The other
// derivatives are central differences.
//
// Outside the contact F is 0. If F jumps at closure or opening, the samples on both sides of the
// jump are left out, because their values depend on sampling and filtering of the record. The sum
// then jumps when closure or opening passes a sample. So a search holds the set of samples in
// contact, and searches are repeated over the possible sets.
//
// Standard errors assume that the residuals are white noise.
#include "law/fit.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <math.h>

#include "law/fit_model.h"

enum { K, START, ZETA, N_UNKNOWN_MAX };  // a law without zeta has two unknowns

// The start value of each unknown. It is not 0, so that changes are relative.
static const double ORIGIN = 1.0;
static const double TOLERANCE = 1e-10;    // of the unknowns, and of the gradient
static const double DIFFERENCE = 1e-6;    // of central differences; impacts have errors of 1e-12
static const double STATIONARY = 1e-6;    // largest cosine between residuals and a derivative
static const double EXACT = 1e-9;         // share of the peak: residuals below are rounding errors
static const double BETTER = 1.0 - 1e-6;  // factor of a normalised error: a real improvement
enum { ITERATIONS_MAX = 200, ROUNDS_MAX = 20 };

struct fit {
    struct fit_model model;
    int n_unknown;
    struct fit_point start;
    double duration;
    const struct fit_samples *held;  // NULL: none
    gsl_multifit_nlinear_workspace *work;
    gsl_matrix *covariance;
};

static struct fit_point point_of(const struct fit *f, const gsl_vector *x) {
    struct fit_point p = f->start;
    p.k *= exp(gsl_vector_get(x, K) - ORIGIN);
    p.start += f->duration * (gsl_vector_get(x, START) - ORIGIN);
    if (f->n_unknown > ZETA) {
        p.zeta *= exp(gsl_vector_get(x, ZETA) - ORIGIN);
    }
    return p;
}

static int residuals(const gsl_vector *x, void *context, gsl_vector *r) {
    struct fit *f = context;
    const struct fit_point p = point_of(f, x);
    fit_model_predict(&f->model, &p, f->held);
    for (size_t i = 0; i < f->model.q->n; i++) {
        gsl_vector_set(r, i, (f->model.force[i] - f->model.q->force[i]) / f->model.peak);
    }
    return GSL_SUCCESS;
}

// Column `u` of the derivatives by central differences.
static void difference(struct fit *f, const gsl_vector *x, size_t u, gsl_matrix *derivative) {
    double at[N_UNKNOWN_MAX];
    gsl_vector_view moved = gsl_vector_view_array(at, (size_t)f->n_unknown);
    gsl_vector_view column = gsl_matrix_column(derivative, u);
    gsl_vector_memcpy(&moved.vector, x);
    gsl_vector_set_zero(&column.vector);
    for (int side = -1; side <= 1; side += 2) {
        gsl_vector_set(&moved.vector, u, gsl_vector_get(x, u) + side * DIFFERENCE);
        const struct fit_point p = point_of(f, &moved.vector);
        fit_model_predict(&f->model, &p, f->held);
        gsl_vector_const_view force = gsl_vector_const_view_array(f->model.force, f->model.q->n);
        gsl_blas_daxpy(side / (2.0 * DIFFERENCE * f->model.peak), &force.vector, &column.vector);
    }
}

static int derivatives(const gsl_vector *x, void *context, gsl_matrix *derivative) {
    struct fit *f = context;
    const struct fit_point p = point_of(f, x);
    fit_model_predict(&f->model, &p, f->held);
    for (size_t i = 0; i < f->model.q->n; i++) {
        gsl_matrix_set(derivative, i, START, -f->model.rate[i] * f->duration / f->model.peak);
    }
    difference(f, x, K, derivative);
    if (f->n_unknown > ZETA) {
        difference(f, x, ZETA, derivative);
    }
    return GSL_SUCCESS;
}

// True if no change of the unknowns makes the residuals smaller: they are orthogonal to all
// derivatives, or rounding.
static bool is_stationary(const struct fit *f) {
    const gsl_vector *residual = gsl_multifit_nlinear_residual(f->work);
    const gsl_matrix *derivative = gsl_multifit_nlinear_jac(f->work);
    double norm = gsl_blas_dnrm2(residual);
    if (norm <= EXACT * sqrt((double)f->model.q->n)) {
        return true;
    }
    for (int u = 0; u < f->n_unknown; u++) {
        gsl_vector_const_view column = gsl_matrix_const_column(derivative, (size_t)u);
        double product;
        gsl_blas_ddot(&column.vector, residual, &product);
        if (!(fabs(product) <= STATIONARY * gsl_blas_dnrm2(&column.vector) * norm)) {
            return false;
        }
    }
    return true;
}

static double normalised_error(const struct fit *f) {
    const struct fit_request *q = f->model.q;
    gsl_vector_const_view measured = gsl_vector_const_view_array(q->force, q->n);
    return gsl_blas_dnrm2(gsl_multifit_nlinear_residual(f->work)) * f->model.peak /
           gsl_blas_dnrm2(&measured.vector);
}

// One search from f->start.
static int search(struct fit *f, struct fit_result *out, struct error *e) {
    double first[N_UNKNOWN_MAX] = {ORIGIN, ORIGIN, ORIGIN};
    gsl_vector_const_view x = gsl_vector_const_view_array(first, (size_t)f->n_unknown);
    gsl_multifit_nlinear_fdf system = {.f = residuals,
                                       .df = derivatives,
                                       .n = f->model.q->n,
                                       .p = (size_t)f->n_unknown,
                                       .params = f};
    int info;
    int status = gsl_multifit_nlinear_init(&x.vector, &system, f->work);
    if (status == GSL_SUCCESS) {
        status = gsl_multifit_nlinear_driver(ITERATIONS_MAX, TOLERANCE, TOLERANCE, 0.0, NULL, NULL,
                                             &info, f->work);
    }
    if (status != GSL_SUCCESS && !is_stationary(f)) {
        return error_set(e, STATUS_FAILED,
                         "the fit of %s does not converge: the normalised error is %.3g %% after "
                         "%zu iterations",
                         f->model.q->law->name, 100.0 * normalised_error(f),
                         gsl_multifit_nlinear_niter(f->work));
    }
    const double degrees = (double)f->model.q->n - f->n_unknown;
    const double sigma = gsl_blas_dnrm2(gsl_multifit_nlinear_residual(f->work)) / sqrt(degrees);
    const struct fit_point p = point_of(f, gsl_multifit_nlinear_position(f->work));
    double error[N_UNKNOWN_MAX] = {0};
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(f->work), 0.0, f->covariance);
    for (int u = 0; u < f->n_unknown; u++) {
        error[u] = sigma * sqrt(gsl_matrix_get(f->covariance, (size_t)u, (size_t)u));
    }
    *out = (struct fit_result){
        .k = {p.k, p.k * error[K]},
        .zeta = {NAN, NAN},
        .start = {p.start, f->duration * error[START]},
        .normalised_error = normalised_error(f),
    };
    if (f->n_unknown > ZETA) {
        out->zeta = (struct fit_parameter){p.zeta, p.zeta * error[ZETA]};
    }
    return STATUS_OK;
}

// The normalised error at `p`, with the samples that are in contact at `p`.
static double error_at(struct fit *f, const struct fit_point *p) {
    const struct fit_request *q = f->model.q;
    gsl_vector_const_view measured = gsl_vector_const_view_array(q->force, q->n);
    return sqrt(fit_model_squares(&f->model, p)) / gsl_blas_dnrm2(&measured.vector);
}

// Searches from `from` with the samples `held` in contact (NULL: no samples are held). *seen: the
// samples that are in contact at the end of the search. True if the result is better than *out.
// Before the first search, the error of *out is infinite.
static bool improve(struct fit *f, const struct fit_point *from, const struct fit_samples *held,
                    struct fit_samples *seen, struct fit_result *out) {
    struct fit_result r;
    struct error unused;
    if (held && (held->first >= held->end || held->end > f->model.q->n)) {
        return false;
    }
    f->start = *from;
    f->held = held;
    if (search(f, &r, &unused) != STATUS_OK) {
        return false;
    }
    const struct fit_point p = {r.k.value, r.zeta.value, r.start.value};
    r.normalised_error = error_at(f, &p);
    *seen = f->model.contact;
    if (!(r.normalised_error < BETTER * out->normalised_error)) {
        return false;
    }
    *out = r;
    return true;
}

// Adds and removes single samples at both ends of the contact while this improves the fit.
static void improve_edges(struct fit *f, struct fit_samples best, struct fit_result *out) {
    bool improved = true;
    for (int i = 0; i < ROUNDS_MAX && improved; i++) {
        improved = false;
        for (int k = 0; k < 4; k++) {
            const struct fit_point from = {out->k.value, out->zeta.value, out->start.value};
            struct fit_samples next = best;
            struct fit_samples seen;
            size_t *edge = k < 2 ? &next.first : &next.end;
            *edge += k % 2 ? 1 : (size_t)-1;
            if (improve(f, &from, &next, &seen, out)) {
                best = next;
                improved = true;
            }
        }
    }
}

// The fit of a law whose force jumps: the best result over the possible sets of samples in contact.
// A search holds the samples that are in contact in the result before. Then sets that differ by
// single samples are tried. False: no result.
static bool search_samples(struct fit *f, struct fit_result *out) {
    const struct fit_point from = f->start;
    struct fit_samples next = f->model.contact;
    out->normalised_error = INFINITY;
    improve(f, &from, NULL, &next, out);
    struct fit_samples best = next;
    for (int i = 0; i < ROUNDS_MAX; i++) {
        struct fit_samples seen = next;
        if (improve(f, &from, &next, &seen, out)) {
            best = next;
        }
        if (seen.first == next.first && seen.end == next.end) {
            break;
        }
        next = seen;
    }
    if (isinf(out->normalised_error)) {
        return false;
    }
    improve_edges(f, best, out);
    return true;
}

static int search_all(struct fit *f, struct fit_result *out, struct error *e) {
    const struct fit_point from = f->start;
    fit_model_predict(&f->model, &from, NULL);
    if ((f->model.jumps_closing || f->model.jumps_opening) && search_samples(f, out)) {
        return STATUS_OK;
    }
    f->start = from;
    f->held = NULL;
    return search(f, out, e);
}

int fit_run(const struct fit_request *request, struct fit_result *out, struct error *e) {
    struct fit f = {.work = NULL};
    int status = fit_model_init(request, &f.model, e);
    f.n_unknown = f.model.damped ? N_UNKNOWN_MAX : ZETA;
    struct fit_result agreed = {.cut = 0.0};
    if (status == STATUS_OK) {
        status = fit_check_impulse(&f.model, &agreed, e);
    }
    if (status == STATUS_OK) {
        const size_t p = (size_t)f.n_unknown;
        gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
        f.work = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, f.model.q->n, p);
        f.covariance = gsl_matrix_alloc(p, p);
        status = f.work && f.covariance ? STATUS_OK : error_no_memory(e);
    }
    if (status == STATUS_OK) {
        status = fit_start(&f.model, &f.start, &f.duration, e);
    }
    if (status == STATUS_OK) {
        status = search_all(&f, out, e);
        out->restitution = agreed.restitution;
        out->cut = agreed.cut;
    }
    if (f.work) {
        gsl_multifit_nlinear_free(f.work);
    }
    if (f.covariance) {
        gsl_matrix_free(f.covariance);
    }
    fit_model_free(&f.model);
    return status;
}
