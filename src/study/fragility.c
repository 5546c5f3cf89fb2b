// SPDX-License-Identifier: GPL-3.0-or-later
// Fits of largest likelihood. With eta = (ln x - ln theta) / beta = a + b z, z the standardised
// logarithm (ln x - middle) / spread of the intensity x, both kinds of fits look for the largest
//     ln L = sum [k ln Phi(eta) + l ln Phi(-eta) - m eta^2 / 2] + M ln b,    M = sum m,
// which is concave in a and b, so that its gradient has one zero, which Newton's method finds.
//
// Counts: at each intensity k runs exceed the limit and l do not (Baker 2015, Earthquake Spectra
// 31(1), 579-599, eq. 11; concave: Pratt 1981, J. Am. Stat. Assoc. 76, 103-106). The zero exists
// unless the exceedances are separated from the rest (Silvapulle 1981, J. R. Stat. Soc. B 43,
// 310-313).
//
// Records: m = 1 where a record first exceeds the limit. If all do, ln theta is the mean and beta
// the standard deviation of ln x (Baker 2015, eq. 5 and 6), with n - 1 as there. A record that
// stays below the limit at all its intensities, up to c, contributes the probability that its
// crossing is above c, 1 - Phi(eta(c)): l = 1 (eq. 9, "truncated" analysis); one that is above it
// from its lowest intensity on, Phi(eta(c)): k = 1. The density of M crossings has the factor b^M
// (concave: Olsen 1978, Econometrica 46, 1211-1215).
#include "study/fragility.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_multiroots.h>
#include <gsl/gsl_sf_erf.h>
#include <math.h>
#include <stdlib.h>

enum { ITERATIONS_MAX = 200 };

// The gradient at the solution, of which each run or record adds a number of the order of one.
static const double RESIDUAL_OF_ONE = 1e-13;

// A slope of rounding size is none.
static const double SLOPE_MIN = 1e-9;

// Below this slope ln b goes on as a parabola, so that Newton's method may pass there.
static const double SLOPE_LOWEST = 1e-3;

// Logarithms that differ by rounding are equal.
static const double SPREAD_MIN = 1e-9;

// What an intensity adds to ln L: the numbers k, l and m of above.
struct term {
    double z, exceed, stay, cross;
};

struct problem {
    int n;
    struct term *term;      // (n) heap
    double n_crossing;      // M
    double middle, spread;  // of the logarithms
};

// The derivative h (h - x) of the hazard h(x) = phi(x) / Phi(-x), which gsl_sf_hazard computes.
static double hazard_slope(double x) {
    const double h = gsl_sf_hazard(x);
    return h * (h - x);
}

static int both(const gsl_vector *x, void *context, gsl_vector *g, gsl_matrix *h) {
    const struct problem *p = context;
    const double a = gsl_vector_get(x, 0), b = gsl_vector_get(x, 1);
    const double low = fmax(b, SLOPE_LOWEST);
    double g0 = 0.0, g1 = p->n_crossing * (2.0 * low - b) / (low * low);
    double h00 = 0.0, h01 = 0.0, h11 = -p->n_crossing / (low * low);
    for (int i = 0; i < p->n; i++) {
        const struct term *t = &p->term[i];
        const double z = t->z, eta = a + b * z;
        const double slope =
            t->exceed * gsl_sf_hazard(-eta) - t->stay * gsl_sf_hazard(eta) - t->cross * eta;
        const double bend =
            -t->exceed * hazard_slope(-eta) - t->stay * hazard_slope(eta) - t->cross;
        g0 += slope;
        g1 += slope * z;
        h00 += bend;
        h01 += bend * z;
        h11 += bend * z * z;
    }
    gsl_vector_set(g, 0, g0);
    gsl_vector_set(g, 1, g1);
    if (h) {
        gsl_matrix_set(h, 0, 0, h00);
        gsl_matrix_set(h, 0, 1, h01);
        gsl_matrix_set(h, 1, 0, h01);
        gsl_matrix_set(h, 1, 1, h11);
    }
    return isfinite(g0) && isfinite(g1) ? GSL_SUCCESS : GSL_EBADFUNC;
}

static int gradient(const gsl_vector *x, void *context, gsl_vector *g) {
    return both(x, context, g, NULL);
}

static int hessian(const gsl_vector *x, void *context, gsl_matrix *h) {
    double g[2];
    gsl_vector_view view = gsl_vector_view_array(g, 2);
    return both(x, context, &view.vector, h);
}

// Newton's method from x[0], x[1], which become a and b.
static int solve(struct problem *p, double residual, double *x, struct error *e) {
    gsl_multiroot_function_fdf f = {gradient, hessian, both, 2, p};
    gsl_multiroot_fdfsolver *solver =
        gsl_multiroot_fdfsolver_alloc(gsl_multiroot_fdfsolver_gnewton, 2);
    if (!solver) {
        return error_no_memory(e);
    }
    gsl_vector_view at = gsl_vector_view_array(x, 2);
    int status = gsl_multiroot_fdfsolver_set(solver, &f, &at.vector), test = GSL_CONTINUE;
    for (int i = 0; i < ITERATIONS_MAX && status == GSL_SUCCESS && test == GSL_CONTINUE; i++) {
        status = gsl_multiroot_fdfsolver_iterate(solver);
        test = gsl_multiroot_test_residual(solver->f, residual);
    }
    gsl_vector_memcpy(&at.vector, solver->x);
    gsl_multiroot_fdfsolver_free(solver);
    return test == GSL_SUCCESS
               ? STATUS_OK
               : error_set(e, STATUS_FAILED, "the fragility curve does not converge: %s",
                           gsl_strerror(test));
}

static struct fragility no_fit(enum fragility_outcome outcome) {
    return (struct fragility){.outcome = outcome,
                              .median = NAN,
                              .dispersion = NAN,
                              .log_median_error = NAN,
                              .dispersion_error = NAN,
                              .between = {NAN, NAN}};
}

// Standard errors from Fisher's information, sum_j n_j h(eta_j) h(-eta_j) grad eta_j grad eta_j^T,
// where grad eta = -(1, eta) / beta for the parameters ln theta and beta.
static void set_errors(const struct fragility_level *level, int n, struct fragility *f) {
    double i00 = 0.0, i01 = 0.0, i11 = 0.0;
    for (int j = 0; j < n; j++) {
        const double eta = log(level[j].intensity / f->median) / f->dispersion;
        const double weight =
            level[j].n * gsl_sf_hazard(eta) * gsl_sf_hazard(-eta) / (f->dispersion * f->dispersion);
        i00 += weight;
        i01 += weight * eta;
        i11 += weight * eta * eta;
    }
    const double determinant = i00 * i11 - i01 * i01;
    f->log_median_error = sqrt(i11 / determinant);
    f->dispersion_error = sqrt(i00 / determinant);
}

// Counts of all levels, and the range of intensities with runs that exceed and runs that do not.
struct overview {
    double n, exceeded;
    double lowest, highest;                  // with runs
    double exceeds_lowest, exceeds_highest;  // with runs above the limit
    double stays_lowest, stays_highest;      // with runs that are not
};

static struct overview look(const struct fragility_level *level, int n) {
    struct overview v = {.lowest = INFINITY,
                         .highest = -INFINITY,
                         .exceeds_lowest = INFINITY,
                         .exceeds_highest = -INFINITY,
                         .stays_lowest = INFINITY,
                         .stays_highest = -INFINITY};
    for (int j = 0; j < n; j++) {
        const double x = level[j].intensity;
        v.n += level[j].n;
        v.exceeded += level[j].exceeded;
        if (level[j].n > 0) {
            v.lowest = fmin(v.lowest, x);
            v.highest = fmax(v.highest, x);
        }
        if (level[j].exceeded > 0) {
            v.exceeds_lowest = fmin(v.exceeds_lowest, x);
            v.exceeds_highest = fmax(v.exceeds_highest, x);
        }
        if (level[j].exceeded < level[j].n) {
            v.stays_lowest = fmin(v.stays_lowest, x);
            v.stays_highest = fmax(v.stays_highest, x);
        }
    }
    return v;
}

static enum fragility_outcome judge(const struct overview *v) {
    return v->n == 0.0                             ? FRAGILITY_NO_RUNS
           : !(v->lowest > 0.0)                    ? FRAGILITY_NOT_POSITIVE
           : v->exceeded == 0.0                    ? FRAGILITY_NONE_EXCEEDS
           : v->exceeded == v->n                   ? FRAGILITY_ALL_EXCEED
           : v->lowest == v->highest               ? FRAGILITY_ONE_LEVEL
           : v->stays_highest <= v->exceeds_lowest ? FRAGILITY_SEPARATED
           : v->exceeds_highest <= v->stays_lowest ? FRAGILITY_FALLS
                                                   : FRAGILITY_FITTED;
}

int fragility_fit(const struct fragility_level *level, int n, struct fragility *out,
                  struct error *e) {
    const struct overview v = look(level, n);
    *out = no_fit(judge(&v));
    out->between[0] = v.stays_highest;
    out->between[1] = v.exceeds_lowest;
    if (out->outcome != FRAGILITY_FITTED) {
        return STATUS_OK;
    }
    struct problem p = {.n = n,
                        .term = calloc((size_t)n, sizeof *p.term),
                        .middle = (log(v.lowest) + log(v.highest)) / 2.0,
                        .spread = log(v.highest / v.lowest) / 4.0};
    double x[2] = {gsl_cdf_ugaussian_Pinv(v.exceeded / v.n), 1.0};
    for (int j = 0; p.term && j < n; j++) {
        p.term[j] = (struct term){.z = (log(level[j].intensity) - p.middle) / p.spread,
                                  .exceed = level[j].exceeded,
                                  .stay = level[j].n - level[j].exceeded};
    }
    const int status = p.term ? solve(&p, RESIDUAL_OF_ONE * v.n, x, e) : error_no_memory(e);
    free(p.term);
    if (status != STATUS_OK) {
        return status;
    }
    struct fragility fit = *out;
    fit.dispersion = p.spread / x[1];
    fit.median = exp(p.middle - fit.dispersion * x[0]);
    set_errors(level, n, &fit);
    // A curve may also be so flat that its median is no number, and neither are the errors then.
    if (x[1] > SLOPE_MIN && isfinite(fit.log_median_error)) {
        *out = fit;
    } else {
        out->outcome = FRAGILITY_FALLS;
    }
    return STATUS_OK;
}

// From the covariance of a and b, the inverse of the observed information: ln theta = middle - a s
// / b and beta = s / b, s the spread.
static void set_record_errors(struct problem *p, double *x, struct fragility *f) {
    double m[4];
    gsl_matrix_view h = gsl_matrix_view_array(m, 2, 2);
    const gsl_vector_view at = gsl_vector_view_array(x, 2);
    hessian(&at.vector, p, &h.matrix);
    const double determinant = m[0] * m[3] - m[1] * m[1];
    const double aa = -m[3] / determinant, ab = m[1] / determinant, bb = -m[0] / determinant;
    const double by_a = -p->spread / x[1], by_b = x[0] * p->spread / (x[1] * x[1]);
    f->log_median_error = sqrt(by_a * by_a * aa + 2.0 * by_a * by_b * ab + by_b * by_b * bb);
    f->dispersion_error = p->spread / (x[1] * x[1]) * sqrt(bb);
}

// With records that do not cross.
static int fit_censored(struct problem *p, const struct fragility_record *record,
                        struct fragility *out, struct error *e) {
    double x[2] = {0.0, 1.0}, squares = 0.0, n = 0.0;
    // The spread is how far the logarithms of all records are from the middle. Those that cross may
    // do so nearly at one intensity, far from where others end, and say little of the scale of the
    // curve.
    for (int i = 0; i < p->n; i++) {
        if (record[i].crossing != CROSSING_NO_RUNS) {
            squares += gsl_pow_2(log(record[i].intensity) - p->middle);
            n++;
        }
    }
    p->spread = sqrt(squares / n);
    for (int i = 0; i < p->n; i++) {
        const enum fragility_crossing crossing = record[i].crossing;
        if (crossing != CROSSING_NO_RUNS) {
            p->term[i] = (struct term){.z = (log(record[i].intensity) - p->middle) / p->spread,
                                       .exceed = crossing == CROSSING_BELOW,
                                       .stay = crossing == CROSSING_ABOVE,
                                       .cross = crossing == CROSSING_AT};
        }
    }
    const int status = solve(p, RESIDUAL_OF_ONE * p->n, x, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!(x[1] > SLOPE_LOWEST)) {
        out->outcome = FRAGILITY_FEW;
        return STATUS_OK;
    }
    out->dispersion = p->spread / x[1];
    out->median = exp(p->middle - out->dispersion * x[0]);
    set_record_errors(p, x, out);
    return STATUS_OK;
}

// How many records there are of each kind, and the moments of those that cross.
struct crossings {
    int n[CROSSING_NO_RUNS + 1];
    double mean, squares;  // of ln x; sum of the squared distances from the mean
    double lowest;         // intensity
};

static struct crossings look_at_records(const struct fragility_record *record, int n) {
    struct crossings v = {.lowest = INFINITY};
    for (int i = 0; i < n; i++) {
        v.n[record[i].crossing]++;
        if (record[i].crossing != CROSSING_NO_RUNS) {
            v.lowest = fmin(v.lowest, record[i].intensity);
        }
        if (record[i].crossing == CROSSING_AT && record[i].intensity > 0.0) {
            const double far = log(record[i].intensity) - v.mean;
            v.mean += far / v.n[CROSSING_AT];
            v.squares += far * (log(record[i].intensity) - v.mean);
        }
    }
    return v;
}

static enum fragility_outcome judge_records(const struct crossings *v, int n) {
    const int with_runs = n - v->n[CROSSING_NO_RUNS];
    return with_runs == 0                      ? FRAGILITY_NO_RUNS
           : v->n[CROSSING_ABOVE] == with_runs ? FRAGILITY_NONE_EXCEEDS
           : v->n[CROSSING_BELOW] == with_runs ? FRAGILITY_ALL_EXCEED
           : !(v->lowest > 0.0)                ? FRAGILITY_NOT_POSITIVE
           : v->n[CROSSING_AT] < 2             ? FRAGILITY_FEW
           : sqrt(v->squares) > SPREAD_MIN     ? FRAGILITY_FITTED
                                               : FRAGILITY_NO_SPREAD;
}

int fragility_fit_records(const struct fragility_record *record, int n, struct fragility *out,
                          struct error *e) {
    const struct crossings v = look_at_records(record, n);
    *out = no_fit(judge_records(&v, n));
    if (out->outcome != FRAGILITY_FITTED) {
        return STATUS_OK;
    }
    struct problem p = {.n = n,
                        .term = calloc((size_t)n, sizeof *p.term),
                        .n_crossing = v.n[CROSSING_AT],
                        .middle = v.mean,
                        .spread = sqrt(v.squares / (v.n[CROSSING_AT] - 1))};
    int status = p.term ? STATUS_OK : error_no_memory(e);
    if (p.term && v.n[CROSSING_ABOVE] + v.n[CROSSING_BELOW] > 0) {
        status = fit_censored(&p, record, out, e);
    } else if (p.term) {
        // Standard errors of a normal sample; that of the standard deviation for large n.
        out->median = exp(p.middle);
        out->dispersion = p.spread;
        out->log_median_error = p.spread / sqrt(p.n_crossing);
        out->dispersion_error = p.spread / sqrt(2.0 * (p.n_crossing - 1.0));
    }
    free(p.term);
    return status;
}

double fragility_probability(const struct fragility *f, double intensity) {
    if (!f->mixed) {
        return gsl_cdf_ugaussian_P(log(intensity / f->median) / f->dispersion);
    }
    const double eta = log(intensity / f->standing_median) / f->standing_dispersion;
    const double collapse = 1.0 / (1.0 + exp(-f->logit[0] - f->logit[1] * log(intensity)));
    return collapse + (1.0 - collapse) * gsl_cdf_ugaussian_P(eta);
}

const char *fragility_reason(const struct fragility *f) {
    static const char *const reason[] = {
        [FRAGILITY_FITTED] = "",
        [FRAGILITY_NO_RUNS] = "no run is left",
        [FRAGILITY_NONE_EXCEEDS] = "no run exceeds the limit",
        [FRAGILITY_ALL_EXCEED] = "all runs exceed the limit",
        [FRAGILITY_SEPARATED] = "one intensity separates the runs above the limit from the others",
        [FRAGILITY_ONE_LEVEL] = "all runs have the same intensity",
        [FRAGILITY_FALLS] = "exceedance does not grow with the intensity",
        [FRAGILITY_NOT_POSITIVE] = "an intensity is not > 0, it has no logarithm",
        [FRAGILITY_FEW] = "fewer than two records first exceed the limit between two intensities",
        [FRAGILITY_NO_SPREAD] = "the records that exceed the limit first do so at one intensity",
        [FRAGILITY_NO_LOGARITHM] = "a demand is not > 0, it has no logarithm; use --method counts",
        [FRAGILITY_FEW_RUNS] = "fewer than three runs at different intensities did not collapse",
        [FRAGILITY_NO_SCATTER] = "all demands lie on the line of the regression",
        [FRAGILITY_NO_LOGIT] = "one intensity separates the runs that collapse from the others",
    };
    return reason[f->outcome];
}
