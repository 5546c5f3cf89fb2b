// SPDX-License-Identifier: GPL-3.0-or-later
// Steffen (1990), Astronomy & Astrophysics 239, 443-450: a cubic between rows that is monotonic
// where the data are.
//
// The shift is the lag of the largest cross-correlation, both sampled at equal intervals. It comes
// from the product of the Fourier transforms, padded with zeros. These count fewer samples at large
// lags, so the search goes on to the largest coefficient of correlation of the samples in common,
// and to the top of the parabola through it and its neighbours.
#include "study/comparison.h"

#include <gsl/gsl_fft_halfcomplex.h>
#include <gsl/gsl_fft_real.h>
#include <gsl/gsl_interp.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

enum { ROWS_MIN = 3, SAMPLES_MAX = 1 << 20 };

// Instants this much beyond the end, over the time from row to row, are rounding.
static const double ROUNDING = 1e-6;

// A curve through a history.
struct curve_through {
    const struct time_series *s;
    gsl_interp *curve;
    gsl_interp_accel *near;
};

static bool curve_open(struct curve_through *c, const struct time_series *s) {
    c->s = s;
    c->curve = gsl_interp_alloc(gsl_interp_steffen, s->n);
    c->near = gsl_interp_accel_alloc();
    return c->curve && c->near && gsl_interp_init(c->curve, s->time, s->value, s->n) == 0;
}

static void curve_close(struct curve_through *c) {
    gsl_interp_free(c->curve);
    gsl_interp_accel_free(c->near);
}

static double curve_at(const struct curve_through *c, double t) {
    t = fmin(fmax(t, c->s->time[0]), c->s->time[c->s->n - 1]);
    return gsl_interp_eval(c->curve, c->s->time, c->s->value, t, c->near);
}

// The rows of the reference within the time of the computed history: from *first, *n of them.
static void comparison_common(const struct time_series *x, const struct time_series *r,
                              size_t *first, size_t *n) {
    const double room = ROUNDING * (x->time[x->n - 1] - x->time[0]) / (double)x->n;
    size_t last = r->n;
    for (*first = 0; *first < r->n && r->time[*first] < x->time[0] - room; ++*first) {
    }
    while (last > *first && r->time[last - 1] > x->time[x->n - 1] + room) {
        last--;
    }
    *n = last - *first;
}

static void comparison_differ(const double *x, const struct time_series *r, double tolerance,
                              struct comparison *out) {
    double square = 0.0, size = 0.0;
    for (size_t i = 0; i < r->n; i++) {
        const double *value[] = {x, r->value};
        for (int k = 0; k < 2; k++) {
            if (fabs(value[k][i]) > out->peak[k]) {
                out->peak[k] = fabs(value[k][i]);
                out->peak_time[k] = r->time[i];
            }
        }
        square += (x[i] - r->value[i]) * (x[i] - r->value[i]);
        size += r->value[i] * r->value[i];
    }
    out->first_time = (double)NAN;
    for (size_t i = 0; i < r->n; i++) {
        const double apart = fabs(x[i] - r->value[i]) / out->peak[1];
        if (apart > out->difference) {
            out->difference = apart;
            out->difference_time = r->time[i];
        }
        if (isnan(out->first_time) && apart > tolerance) {
            out->first_time = r->time[i];
        }
    }
    out->error = sqrt(square / size);
    out->correlation = gsl_stats_correlation(x, 1, r->value, 1, r->n);
}

// Multiplies the transform of x by the conjugate of that of r, as GSL stores them.
static void comparison_multiply(double *x, const double *r, size_t n) {
    x[0] *= r[0];
    x[n / 2] *= r[n / 2];
    for (size_t i = 1; i < n / 2; i++) {
        const double real = x[i] * r[i] + x[n - i] * r[n - i];
        x[n - i] = x[n - i] * r[i] - x[i] * r[n - i];
        x[i] = real;
    }
}

// The correlation of x, k samples later, with r: of the samples that both have.
static double comparison_at_lag(const double *x, const double *r, long n, long k) {
    const long from_x = k > 0 ? k : 0, from_r = k > 0 ? 0 : -k, common = n - labs(k);
    return common < ROWS_MIN ? -1.0
                             : gsl_stats_correlation(x + from_x, 1, r + from_r, 1, (size_t)common);
}

// The lag of the nearest maximum of the correlation, in samples, from `k` on.
static double comparison_climb(const double *x, const double *r, long n, long k) {
    const double here = comparison_at_lag(x, r, n, k);
    const long way = comparison_at_lag(x, r, n, k + 1) > here ? 1 : -1;
    for (double best = here, next; labs(k) < n; k += way, best = next) {
        next = comparison_at_lag(x, r, n, k + way);
        if (!(next > best)) {
            break;
        }
    }
    const double before = comparison_at_lag(x, r, n, k - 1);
    const double after = comparison_at_lag(x, r, n, k + 1);
    const double bend = before - 2.0 * comparison_at_lag(x, r, n, k) + after;
    return bend < 0.0 ? (double)k + 0.5 * (before - after) / bend : (double)k;
}

// The lag of the largest value of a circular correlation of n samples.
static long comparison_largest(const double *c, size_t n) {
    size_t best = 0;
    for (size_t i = 1; i < n; i++) {
        best = c[i] > c[best] ? i : best;
    }
    return best < n / 2 ? (long)best : (long)best - (long)n;
}

// False: no memory.
static bool comparison_find_shift(const struct curve_through *x, const struct curve_through *r,
                                  const struct time_series *common, double *shift) {
    const double start = common->time[0], length = common->time[common->n - 1] - start;
    const size_t samples = common->n < SAMPLES_MAX ? common->n : SAMPLES_MAX;
    const double step = length / (double)(samples - 1);
    size_t n = 1;
    while (n < 2 * samples) {
        n *= 2;
    }
    double *a = calloc(2 * (n + samples), sizeof *a);
    if (!a) {
        return false;
    }
    double *b = a + n, *of_x = b + n, *of_r = of_x + samples;
    for (size_t i = 0; i < samples; i++) {
        a[i] = of_x[i] = curve_at(x, start + step * (double)i);
        b[i] = of_r[i] = curve_at(r, start + step * (double)i);
    }
    gsl_fft_real_radix2_transform(a, 1, n);
    gsl_fft_real_radix2_transform(b, 1, n);
    comparison_multiply(a, b, n);
    gsl_fft_halfcomplex_radix2_inverse(a, 1, n);
    *shift = step * comparison_climb(of_x, of_r, (long)samples, comparison_largest(a, n));
    free(a);
    return true;
}

static int comparison_few(const struct time_series *x, const struct time_series *r,
                          struct error *e) {
    return error_set(e, STATUS_INPUT,
                     "the histories have fewer than %d instants in common: one is from %.6g to "
                     "%.6g, the other from %.6g to %.6g",
                     ROWS_MIN, x->time[0], x->time[x->n - 1], r->time[0], r->time[r->n - 1]);
}

int comparison_make(const struct time_series *computed, const struct time_series *reference,
                    double tolerance, struct comparison *out, struct error *e) {
    size_t first = 0, n = 0;
    *out = (struct comparison){0};
    if (computed->n >= ROWS_MIN) {
        comparison_common(computed, reference, &first, &n);
    }
    if (n < ROWS_MIN) {
        return comparison_few(computed, reference, e);
    }
    const struct time_series common = {n, reference->time + first, reference->value + first};
    struct curve_through x, r;
    double *at = malloc(n * sizeof *at);
    const bool opened = curve_open(&x, computed), both = curve_open(&r, reference);
    bool made = at && opened && both;
    for (size_t i = 0; made && i < n; i++) {
        at[i] = curve_at(&x, common.time[i]);
    }
    if (made) {
        comparison_differ(at, &common, tolerance, out);
        made = comparison_find_shift(&x, &r, &common, &out->shift);
    }
    curve_close(&x);
    curve_close(&r);
    free(at);
    return made ? STATUS_OK : error_no_memory(e);
}
