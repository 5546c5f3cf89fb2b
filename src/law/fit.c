// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares over the samples of a record,
//
//     sum over i of (F_i - F(t_i - t0; k, zeta))^2 = min.
//
// F is the force of an isolated impact and t0 the instant of closure (least_squares.h). Jankowski
// (2005), Earthquake Eng. Struct. Dyn. 34, 595-611, fitted by hand. His normalised error is the
// square root of this sum over that of F = 0.
//
// The unknowns are the logarithms of k and zeta, which keeps both positive, and t0 over the
// duration of the impact. The derivative with respect to t0 follows from the law. The other
// derivatives are central differences.
//
// Outside the contact F is 0. If F jumps at closure or opening, the samples on both sides of the
// jump are left out, because their values depend on sampling and filtering of the record. The sum
// then jumps when closure or opening passes a sample. So a search holds the set of samples in
// contact, and searches are repeated over the possible sets.
#include "law/fit.h"

#include <gsl/gsl_blas.h>
#include <math.h>
#include <string.h>

#include "law/fit_model.h"
#include "law/least_squares.h"

enum { K, START, ZETA, N_UNKNOWN_MAX };  // a law without zeta has two unknowns

static const double BETTER = 1.0 - 1e-6;  // factor of a normalised error: a real improvement
enum { ROUNDS_MAX = 20 };

struct fit {
    struct fit_model model;
    struct fit_point start;
    double duration;
    const struct fit_samples *held;  // NULL: none
    struct least_squares squares;
};

static struct fit_point point_of(const struct fit *f, const double *x) {
    struct fit_point p = f->start;
    p.k *= exp(x[K] - least_squares_origin);
    p.start += f->duration * (x[START] - least_squares_origin);
    if (f->squares.n_unknown > ZETA) {
        p.zeta *= exp(x[ZETA] - least_squares_origin);
    }
    return p;
}

static void predict(void *context, const double *x, double *value) {
    struct fit *f = context;
    const struct fit_point p = point_of(f, x);
    fit_model_predict(&f->model, &p, f->held);
    memcpy(value, f->model.force, f->model.q->n * sizeof *value);
}

static bool derivative(void *context, const double *x, int u, double *column) {
    struct fit *f = context;
    if (u != START) {
        return false;
    }
    const struct fit_point p = point_of(f, x);
    fit_model_predict(&f->model, &p, f->held);
    for (size_t i = 0; i < f->model.q->n; i++) {
        column[i] = -f->model.rate[i] * f->duration;
    }
    return true;
}

// One search from f->start.
static int search(struct fit *f, struct fit_result *out, struct error *e) {
    struct least_squares_result found;
    const int status = least_squares_search(&f->squares, &found, e);
    if (status != STATUS_OK) {
        return status;
    }
    const struct fit_point p = point_of(f, found.x);
    *out = (struct fit_result){
        .k = {p.k, p.k * found.error[K]},
        .zeta = {NAN, NAN},
        .start = {p.start, f->duration * found.error[START]},
        .normalised_error = found.normalised_error,
    };
    if (f->squares.n_unknown > ZETA) {
        out->zeta = (struct fit_parameter){p.zeta, p.zeta * found.error[ZETA]};
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
    struct fit f = {.held = NULL};
    int status = fit_model_init(request, &f.model, e);
    struct fit_result agreed = {.cut = 0.0};
    if (status == STATUS_OK) {
        status = fit_check_impulse(&f.model, &agreed, e);
    }
    if (status == STATUS_OK) {
        f.squares = (struct least_squares){.name = request->law->name,
                                           .n = request->n,
                                           .n_unknown = f.model.damped ? N_UNKNOWN_MAX : ZETA,
                                           .measured = request->force,
                                           .scale = f.model.peak,
                                           .predict = predict,
                                           .derivative = derivative,
                                           .context = &f};
        status = least_squares_open(&f.squares, e);
    }
    if (status == STATUS_OK) {
        status = fit_start(&f.model, &f.start, &f.duration, e);
    }
    if (status == STATUS_OK) {
        status = search_all(&f, out, e);
        out->restitution = agreed.restitution;
        out->cut = agreed.cut;
    }
    least_squares_close(&f.squares);
    fit_model_free(&f.model);
    return status;
}
