// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/hazard.h"

#include <assert.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_erf.h>
#include <math.h>

#include "core/arena.h"
#include "motion/time_series.h"

enum { PIECES_MAX = 1000 };
static const double PIECE_ERROR = 1e-9;  // relative

int hazard_read(struct arena *a, const char *path, struct dimension dimension, double unit,
                struct hazard *out, struct error *e) {
    const struct time_series_column column[TIME_SERIES_COLUMNS] = {
        {"intensity", dimension, unit, &range_positive},
        {"rate", dimension_none, 1.0, &range_positive},
    };
    struct time_series points;
    const int status = time_series_read(a, path, column, &points, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (points.n < 2) {
        return error_set(e, STATUS_INPUT, "%s: a hazard curve has at least two points", path);
    }
    double *intensity = arena_alloc(a, points.n, sizeof *intensity);
    if (!intensity) {
        return error_no_memory(e);
    }
    for (size_t i = 0; i < points.n; i++) {
        intensity[i] = points.time[i] / unit;
        if (i > 0 && !(points.value[i] < points.value[i - 1])) {
            return error_set(e, STATUS_INPUT,
                             "%s: the rate does not fall from intensity %.6g to %.6g", path,
                             intensity[i - 1], intensity[i]);
        }
    }
    *out = (struct hazard){points.n, intensity, points.value};
    return STATUS_OK;
}

static double log_normal(double z) {
    return gsl_sf_log_erfc(-z / M_SQRT2) - M_LN2;
}

// exp(factor) [Phi(to) - Phi(from)], also where the factor overflows and the difference is tiny.
static double between(double factor, double from, double to) {
    return from > 0.0 ? exp(factor + log_normal(-from)) - exp(factor + log_normal(-to))
                      : exp(factor + log_normal(to)) - exp(factor + log_normal(from));
}

// The rate between two points, on which it is r0 (x / x0)^-k, by parts:
//     integral of P |d rate| = P0 r0 - P1 r1 + integral of rate dP,
// where the last integral is r0 exp(k ln(x0 / theta) + k^2 beta^2 / 2) [Phi(u1 + k beta) -
// Phi(u0 + k beta)], u = ln(x / theta) / beta.
static double lognormal_exceedances(const struct fragility *f, const double *x,
                                    const double *rate) {
    const double beta = f->dispersion, k = log(rate[0] / rate[1]) / log(x[1] / x[0]);
    const double low = log(x[0] / f->median), high = log(x[1] / f->median);
    const double sum = fragility_probability(f, x[0]) * rate[0] -
                       fragility_probability(f, x[1]) * rate[1] +
                       rate[0] * between(k * low + gsl_pow_2(k * beta) / 2.0, low / beta + k * beta,
                                         high / beta + k * beta);
    return fmax(sum, 0.0);  // it may be below by rounding
}

// The integrand k P(x) rate(x) over ln x.
struct mixture {
    const struct fragility *f;
    double start, rate, k;
};

static double mixture_density(double at, void *context) {
    const struct mixture *m = context;
    return m->k * m->rate * exp(-m->k * (at - m->start)) * fragility_probability(m->f, exp(at));
}

// The same rate of a curve with collapses, which has no closed form: by Gauss and Kronrod, on
// pieces as long as the curve takes to rise.
static double mixture_exceedances(const struct fragility *f, const double *x, const double *rate) {
    struct mixture m = {f, log(x[0]), rate[0], log(rate[0] / rate[1]) / log(x[1] / x[0])};
    gsl_function density = {mixture_density, &m};
    const double length = log(x[1] / x[0]);
    const double piece = fmin(f->standing_dispersion, 1.0 / f->logit[1]);
    const double n = fmin(ceil(length / piece), PIECES_MAX);
    double sum = 0.0;
    for (int i = 0; i < (int)n; i++) {
        double part, error;
        size_t n_value;
        gsl_integration_qng(&density, m.start + i / n * length, m.start + (i + 1) / n * length, 0.0,
                            PIECE_ERROR, &part, &error, &n_value);
        sum += part;
    }
    return sum;
}

static double exceedances(const struct fragility *f, const double *x, const double *rate) {
    return f->mixed ? mixture_exceedances(f, x, rate) : lognormal_exceedances(f, x, rate);
}

// Of the curve at an intensity of the part from point `i` to the next.
static double rate_at(const struct hazard *h, size_t i, double x) {
    const double *at = h->intensity + i, *rate = h->rate + i;
    return rate[0] * pow(rate[1] / rate[0], log(x / at[0]) / log(at[1] / at[0]));
}

double hazard_exceedances(const struct hazard *h, const struct fragility *f, double to) {
    assert(h->n >= 2);
    if (f->outcome != FRAGILITY_FITTED) {
        return NAN;
    }
    double sum = 0.0;
    for (size_t i = 0; i + 1 < h->n && h->intensity[i] < to; i++) {
        const bool whole = to >= h->intensity[i + 1];
        const double x[] = {h->intensity[i], whole ? h->intensity[i + 1] : to};
        const double rate[] = {h->rate[i], whole ? h->rate[i + 1] : rate_at(h, i, to)};
        sum += exceedances(f, x, rate);
    }
    const size_t last = h->n - 1;
    return isinf(to) ? sum + fragility_probability(f, h->intensity[last]) * h->rate[last] : sum;
}

double hazard_beyond(const struct hazard *h, const struct fragility *f) {
    const size_t last = h->n - 1;
    return (1.0 - fragility_probability(f, h->intensity[last])) * h->rate[last];
}
