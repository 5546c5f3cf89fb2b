// SPDX-License-Identifier: GPL-3.0-or-later
// With eta_j = (ln x_j - ln theta) / beta = a + b z_j, z the standardised logarithm of the
// intensity, the likelihood of k exceedances among n,
//     ln L = sum_j [k_j ln Phi(eta_j) + (n_j - k_j) ln Phi(-eta_j)]    (Baker 2015, eq. 11),
// is concave in a and b (Pratt 1981, J. Am. Stat. Assoc. 76, 103-106), so that its gradient has one
// zero, which Newton's method finds. With the hazard h(x) = phi(x) / Phi(-x), whose derivative is
// h (h - x), the gradient is sum_j [k_j h(-eta_j) - (n_j - k_j) h(eta_j)] (1, z_j). The zero exists
// unless the exceedances are separated from the rest (Silvapulle 1981, J. R. Stat. Soc. B 43,
// 310-313).
#include "study/fragility.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>
#include <math.h>

#include "study/likelihood.h"

// The gradient at the solution, of which each run adds a number of the order of one.
static const double RESIDUAL_OF_A_RUN = 1e-13;

// A slope of rounding size is none.
static const double SLOPE_MIN = 1e-9;

// Intensities as z = (ln x - middle) / spread.
struct problem {
    const struct fragility_level *level;
    int n;
    double n_run;
    double middle, spread;
};

static double place(const struct problem *p, int j) {
    return (log(p->level[j].intensity) - p->middle) / p->spread;
}

static int gradient(const gsl_vector *x, void *context, gsl_vector *out) {
    const struct problem *p = context;
    double g[2] = {0.0, 0.0};
    for (int j = 0; j < p->n; j++) {
        const double z = place(p, j), eta = gsl_vector_get(x, 0) + gsl_vector_get(x, 1) * z;
        const int k = p->level[j].exceeded;
        const double pull = k * gsl_sf_hazard(-eta) - (p->level[j].n - k) * gsl_sf_hazard(eta);
        g[0] += pull;
        g[1] += pull * z;
    }
    gsl_vector_set(out, 0, g[0]);
    gsl_vector_set(out, 1, g[1]);
    return isfinite(g[0]) && isfinite(g[1]) ? GSL_SUCCESS : GSL_EBADFUNC;
}

static int hessian(const gsl_vector *x, void *context, gsl_matrix *out) {
    const struct problem *p = context;
    gsl_matrix_set_zero(out);
    for (int j = 0; j < p->n; j++) {
        const double z = place(p, j), eta = gsl_vector_get(x, 0) + gsl_vector_get(x, 1) * z;
        const int k = p->level[j].exceeded;
        const double bend =
            -k * likelihood_hazard_slope(-eta) - (p->level[j].n - k) * likelihood_hazard_slope(eta);
        *gsl_matrix_ptr(out, 0, 0) += bend;
        *gsl_matrix_ptr(out, 0, 1) += bend * z;
        *gsl_matrix_ptr(out, 1, 1) += bend * z * z;
    }
    gsl_matrix_set(out, 1, 0, gsl_matrix_get(out, 0, 1));
    return GSL_SUCCESS;
}

static int both(const gsl_vector *x, void *context, gsl_vector *g, gsl_matrix *h) {
    const int status = gradient(x, context, g);
    return status == GSL_SUCCESS ? hessian(x, context, h) : status;
}

// Standard errors from Fisher's information, sum_j n_j h(eta_j) h(-eta_j) grad eta_j grad eta_j^T,
// where grad eta = -(1, eta) / beta for the parameters ln theta and beta.
static void set_errors(const struct problem *p, struct fragility *f) {
    double i00 = 0.0, i01 = 0.0, i11 = 0.0;
    for (int j = 0; j < p->n; j++) {
        const double eta = log(p->level[j].intensity / f->median) / f->dispersion;
        const double weight = p->level[j].n * gsl_sf_hazard(eta) * gsl_sf_hazard(-eta) /
                              (f->dispersion * f->dispersion);
        i00 += weight;
        i01 += weight * eta;
        i11 += weight * eta * eta;
    }
    const double determinant = i00 * i11 - i01 * i01;
    f->log_median_error = sqrt(i11 / determinant);
    f->dispersion_error = sqrt(i00 / determinant);
}

static int solve(struct problem *p, double fraction, struct fragility *out, struct error *e) {
    gsl_multiroot_function_fdf f = {gradient, hessian, both, 2, p};
    double x[2] = {gsl_cdf_ugaussian_Pinv(fraction), 1.0};
    const int status = likelihood_solve(&f, RESIDUAL_OF_A_RUN * p->n_run, x, e);
    if (status != STATUS_OK) {
        return status;
    }
    struct fragility fit = *out;
    fit.dispersion = p->spread / x[1];
    fit.median = exp(p->middle - fit.dispersion * x[0]);
    set_errors(p, &fit);
    // A curve may also be so flat that its median is no number, and neither are the errors then.
    if (x[1] > SLOPE_MIN && isfinite(fit.log_median_error)) {
        *out = fit;
    } else {
        out->outcome = FRAGILITY_FALLS;
    }
    return STATUS_OK;
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
    if (v->n == 0.0) {
        return FRAGILITY_NO_RUNS;
    }
    if (!(v->lowest > 0.0)) {
        return FRAGILITY_NOT_POSITIVE;
    }
    if (v->exceeded == 0.0) {
        return FRAGILITY_NONE_EXCEEDS;
    }
    if (v->exceeded == v->n) {
        return FRAGILITY_ALL_EXCEED;
    }
    if (v->lowest == v->highest) {
        return FRAGILITY_ONE_LEVEL;
    }
    if (v->stays_highest <= v->exceeds_lowest) {
        return FRAGILITY_SEPARATED;
    }
    return v->exceeds_highest <= v->stays_lowest ? FRAGILITY_FALLS : FRAGILITY_FITTED;
}

int fragility_fit(const struct fragility_level *level, int n, struct fragility *out,
                  struct error *e) {
    const struct overview v = look(level, n);
    *out = (struct fragility){.outcome = judge(&v),
                              .median = NAN,
                              .dispersion = NAN,
                              .log_median_error = NAN,
                              .dispersion_error = NAN,
                              .between = {v.stays_highest, v.exceeds_lowest}};
    if (out->outcome != FRAGILITY_FITTED) {
        return STATUS_OK;
    }
    struct problem p = {.level = level,
                        .n = n,
                        .n_run = v.n,
                        .middle = (log(v.lowest) + log(v.highest)) / 2.0,
                        .spread = log(v.highest / v.lowest) / 4.0};
    return solve(&p, v.exceeded / v.n, out, e);
}

double fragility_probability(const struct fragility *f, double intensity) {
    return gsl_cdf_ugaussian_P(log(intensity / f->median) / f->dispersion);
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
    };
    return reason[f->outcome];
}

void fragility_count(const struct suite *s, int group, double limit,
                     struct fragility_level *level) {
    for (int j = 0; j < s->n_point; j++) {
        level[j] = (struct fragility_level){.intensity = s->point[j]};
        for (int k = 0; k < s->n_sample; k++) {
            const double x = suite_value(s, group, k, j);
            level[j].n += isnan(x) ? 0 : 1;
            level[j].exceeded += x > limit ? 1 : 0;
        }
    }
}
