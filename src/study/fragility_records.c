// SPDX-License-Identifier: GPL-3.0-or-later
// Fragility from the intensities x_i at which records first exceed the limit. If all do, ln theta
// is the mean and beta the standard deviation of ln x_i (Baker 2015, Earthquake Spectra 31(1),
// 579-599, eq. 5 and 6), with n - 1 as there.
//
// A record that stays below the limit at all its intensities, up to c, contributes the probability
// that its crossing is above c, 1 - Phi(eta(c)) (eq. 9, "truncated" analysis); one that is above
// it from its lowest intensity on, Phi(eta(c)). With eta = (ln x - ln theta) / beta = a + b z, z
// the standardised logarithm,
//     ln L = m ln b - sum eta_i^2 / 2 + sum_above ln Phi(-eta) + sum_below ln Phi(eta)
// is concave in a and b (Olsen 1978, Econometrica 46, 1211-1215). The density of m crossings has
// the factor b^m.
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_erf.h>
#include <math.h>

#include "study/fragility.h"
#include "study/likelihood.h"

static const double RESIDUAL_OF_A_RECORD = 1e-13;

// Below this slope ln b goes on as a parabola, so that Newton's method may pass there.
static const double SLOPE_LOWEST = 1e-3;

// Logarithms that differ by rounding are equal.
static const double SPREAD_MIN = 1e-9;

struct problem {
    const struct fragility_record *record;
    int n;
    double n_crossing;      // records with CROSSING_AT
    double middle, spread;  // of their logarithms
};

// The first and second derivatives by eta of what a record adds to ln L.
struct bend {
    double slope, curvature;
};

static struct bend bend_at(enum fragility_crossing crossing, double eta) {
    switch (crossing) {
        case CROSSING_AT:
            return (struct bend){-eta, -1.0};
        case CROSSING_ABOVE:
            return (struct bend){-gsl_sf_hazard(eta), -likelihood_hazard_slope(eta)};
        case CROSSING_BELOW:
            return (struct bend){gsl_sf_hazard(-eta), -likelihood_hazard_slope(-eta)};
        default:
            return (struct bend){0.0, 0.0};
    }
}

static double place(const struct problem *p, int i) {
    const struct fragility_record *r = &p->record[i];
    return r->crossing == CROSSING_NO_RUNS ? 0.0 : (log(r->intensity) - p->middle) / p->spread;
}

static int both(const gsl_vector *x, void *context, gsl_vector *g, gsl_matrix *h) {
    const struct problem *p = context;
    const double a = gsl_vector_get(x, 0), b = gsl_vector_get(x, 1);
    const double low = fmax(b, SLOPE_LOWEST);
    double g0 = 0.0, g1 = p->n_crossing * (2.0 * low - b) / (low * low);
    double h00 = 0.0, h01 = 0.0, h11 = -p->n_crossing / (low * low);
    for (int i = 0; i < p->n; i++) {
        const double z = place(p, i);
        const struct bend t = bend_at(p->record[i].crossing, a + b * z);
        g0 += t.slope;
        g1 += t.slope * z;
        h00 += t.curvature;
        h01 += t.curvature * z;
        h11 += t.curvature * z * z;
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

// From the covariance of a and b, the inverse of the observed information: ln theta = middle - a s
// / b and beta = s / b, s the spread.
static void set_errors(struct problem *p, double *x, struct fragility *f) {
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

// How far the logarithms of all records are from the middle. Those that cross may do so nearly at
// one intensity, far from where others end, and say little of the scale of the curve.
static double spread_of_all(const struct problem *p) {
    double squares = 0.0, n = 0.0;
    for (int i = 0; i < p->n; i++) {
        if (p->record[i].crossing != CROSSING_NO_RUNS) {
            squares += gsl_pow_2(log(p->record[i].intensity) - p->middle);
            n++;
        }
    }
    return sqrt(squares / n);
}

static int fit_censored(struct problem *p, struct fragility *out, struct error *e) {
    gsl_multiroot_function_fdf f = {gradient, hessian, both, 2, p};
    p->spread = spread_of_all(p);
    double x[2] = {0.0, 1.0};
    const int status = likelihood_solve(&f, RESIDUAL_OF_A_RECORD * p->n, x, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (!(x[1] > SLOPE_LOWEST)) {
        out->outcome = FRAGILITY_FEW;
        return STATUS_OK;
    }
    out->dispersion = p->spread / x[1];
    out->median = exp(p->middle - out->dispersion * x[0]);
    set_errors(p, x, out);
    return STATUS_OK;
}

// Standard errors of a normal sample; that of the standard deviation for large n.
static void fit_complete(const struct problem *p, struct fragility *out) {
    out->median = exp(p->middle);
    out->dispersion = p->spread;
    out->log_median_error = p->spread / sqrt(p->n_crossing);
    out->dispersion_error = p->spread / sqrt(2.0 * (p->n_crossing - 1.0));
}

// How many records there are of each kind, and the moments of those that cross.
struct overview {
    int n[CROSSING_NO_RUNS + 1];
    double mean, squares;  // of ln x; sum of the squared distances from the mean
    double lowest;         // intensity
};

static struct overview look(const struct fragility_record *record, int n) {
    struct overview v = {.lowest = INFINITY};
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

static enum fragility_outcome judge(const struct overview *v, int n) {
    const int with_runs = n - v->n[CROSSING_NO_RUNS];
    if (with_runs == 0) {
        return FRAGILITY_NO_RUNS;
    }
    if (v->n[CROSSING_ABOVE] == with_runs) {
        return FRAGILITY_NONE_EXCEEDS;
    }
    if (v->n[CROSSING_BELOW] == with_runs) {
        return FRAGILITY_ALL_EXCEED;
    }
    if (!(v->lowest > 0.0)) {
        return FRAGILITY_NOT_POSITIVE;
    }
    if (v->n[CROSSING_AT] < 2) {
        return FRAGILITY_FEW;
    }
    return sqrt(v->squares) > SPREAD_MIN ? FRAGILITY_FITTED : FRAGILITY_NO_SPREAD;
}

int fragility_fit_records(const struct fragility_record *record, int n, struct fragility *out,
                          struct error *e) {
    const struct overview v = look(record, n);
    *out = (struct fragility){.outcome = judge(&v, n),
                              .median = NAN,
                              .dispersion = NAN,
                              .log_median_error = NAN,
                              .dispersion_error = NAN,
                              .between = {NAN, NAN}};
    if (out->outcome != FRAGILITY_FITTED) {
        return STATUS_OK;
    }
    struct problem p = {.record = record,
                        .n = n,
                        .n_crossing = v.n[CROSSING_AT],
                        .middle = v.mean,
                        .spread = sqrt(v.squares / (v.n[CROSSING_AT] - 1))};
    if (v.n[CROSSING_ABOVE] + v.n[CROSSING_BELOW] > 0) {
        return fit_censored(&p, out, e);
    }
    fit_complete(&p, out);
    return STATUS_OK;
}

static struct fragility_record first(const struct suite *s, int group, int sample, double limit) {
    struct fragility_record r = {CROSSING_NO_RUNS, NAN};
    double last = NAN;
    for (int j = 0; j < s->n_point; j++) {
        const double x = suite_value(s, group, sample, j);
        if (isnan(x)) {
            continue;
        }
        if (x > limit && r.crossing == CROSSING_NO_RUNS) {
            return (struct fragility_record){CROSSING_BELOW, s->point[j]};
        }
        if (x > limit) {
            const double share = isinf(x) ? 1.0 : (limit - last) / (x - last);
            return (struct fragility_record){CROSSING_AT,
                                             r.intensity + share * (s->point[j] - r.intensity)};
        }
        r = (struct fragility_record){CROSSING_ABOVE, s->point[j]};
        last = x;
    }
    return r;
}

void fragility_first(const struct suite *s, int group, double limit,
                     struct fragility_record *record) {
    for (int k = 0; k < s->n_sample; k++) {
        record[k] = first(s, group, k, limit);
    }
}
