// SPDX-License-Identifier: GPL-3.0-or-later
// Random values by the inverse of the distribution, x = F^-1(u), with one u for each x. u is the
// probability of a value below x. A Latin hypercube divides the range of u into strata.
//
//   normal      F^-1(u) = a + b z       a: mean, b: standard deviation
//   lognormal   F^-1(u) = a exp(b z)    a: median, b: standard deviation of ln x, the dispersion
//   uniform     F^-1(u) = a + (b - a) u
//
// where Phi(z) = u. Truncated to [min, max]: Phi(z) = Phi(z_min) + u (Phi(z_max) - Phi(z_min)).
// Above the mean the complement Q = 1 - Phi is used, so that far tails keep their digits.
//
// Independent: u_i = (m_i + 1/2) / 2^32, with m_i the numbers of the Mersenne twister MT19937
// (Matsumoto & Nishimura 1998, ACM Trans. Model. Comput. Simul. 8, 3-30; GSL's), never 0 nor 1.
// Latin hypercube (McKay, Beckman & Conover 1979, Technometrics 21, 239-245): u_i = (p_i + w_i) /
// n, with p a random permutation of 0 ... n - 1, drawn first, and w_i as u_i above.
//
// Correlated (Gaussian copula): the standard normal scores z of the parameters are mixed, z' = L z,
// with L the Cholesky factor of the correlation matrix of z', and u_i = Phi(z'_i) (e.g. Melchers &
// Beck 2018, Structural Reliability Analysis and Prediction, appendix B). Row k of L uses the
// parameters above only, so that a further one does not change their values. In a Latin hypercube
// the u_i are put into the order of the z'_i, so that every stratum keeps its value (Iman & Conover
// 1982, Commun. Stat. Simul. Comput. 11, 311-334, put ranks into the order of correlated scores,
// too).
//
// The twister starts from the seed and the name of the parameter: the 64 bits of FNV-1a over "SEED
// NAME", folded to 32. So parameters do not share numbers, and adding a parameter does not change
// the values of the others.
#include "deck/random.h"

#include <assert.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"

static const char *fault_of_normal(double a, double b, int *at) {
    (void)a;
    *at = 1;
    return b > 0.0 ? NULL : "the standard deviation must be > 0";
}

static double score_of_normal(double a, double b, double x) {
    return (x - a) / b;
}

static double normal_value(double a, double b, double z) {
    return a + b * z;
}

static const char *fault_of_lognormal(double a, double b, int *at) {
    *at = a > 0.0;
    return !(a > 0.0) ? "the median must be > 0" : !(b > 0.0) ? "the dispersion must be > 0" : NULL;
}

static double score_of_lognormal(double a, double b, double x) {
    return x > 0.0 ? log(x / a) / b : -INFINITY;
}

static double lognormal_value(double a, double b, double z) {
    return a * exp(b * z);
}

static const char *fault_of_uniform(double a, double b, int *at) {
    *at = 1;
    return a < b ? NULL : "the lower end must be below the upper one";
}

static double uniform_value(double a, double b, double u) {
    return a + (b - a) * u;
}

static const struct distribution normal = {
    .name = "normal",
    .arguments = "MEAN SD",
    .fault = fault_of_normal,
    .score = score_of_normal,
    .value = normal_value,
};

static const struct distribution lognormal = {
    .name = "lognormal",
    .arguments = "MEDIAN DISPERSION",
    .pure_b = "the dispersion, a standard deviation of logarithms,",
    .fault = fault_of_lognormal,
    .score = score_of_lognormal,
    .value = lognormal_value,
};

static const struct distribution uniform = {
    .name = "uniform",
    .arguments = "LOW HIGH",
    .fault = fault_of_uniform,
    .value = uniform_value,
};

const struct distribution *const random_distributions[] = {&normal, &lognormal, &uniform};
const int n_random_distribution = sizeof random_distributions / sizeof random_distributions[0];

// The sampled part of the standard normal distribution: from the probability `p` upwards by
// `width`. Both are probabilities of the lower tail, or of the upper tail, which is sampled
// downwards.
struct part {
    enum { LOWER_TAIL, UPPER_TAIL } tail;
    double p, width;
};

static struct part part_of(const struct random_values *r) {
    const double from = r->distribution->score(r->a, r->b, r->min),
                 to = r->distribution->score(r->a, r->b, r->max);
    if (from > 0.0) {
        const double q = gsl_cdf_ugaussian_Q(from);
        return (struct part){UPPER_TAIL, q, q - gsl_cdf_ugaussian_Q(to)};
    }
    const double p = gsl_cdf_ugaussian_P(from);
    return (struct part){LOWER_TAIL, p, gsl_cdf_ugaussian_P(to) - p};
}

static double score_at(const struct part *part, double u) {
    return part->tail == UPPER_TAIL ? gsl_cdf_ugaussian_Qinv(part->p - u * part->width)
                                    : gsl_cdf_ugaussian_Pinv(part->p + u * part->width);
}

static unsigned long seed_of(const struct random_values *r) {
    char text[16];
    const int length = snprintf(text, sizeof text, "%d ", r->seed);
    uint64_t sum = hash_add(hash_start, text, (size_t)length);
    sum = hash_add(sum, r->name, strlen(r->name));
    return (unsigned long)((sum >> 32 ^ sum) & 0xffffffffu);
}

static double probability(const gsl_rng *twister) {
    return ((double)gsl_rng_get(twister) + 0.5) / 4294967296.0;
}

double random_value(const struct random_values *r, double u) {
    const struct distribution *d = r->distribution;
    if (d->score) {
        const struct part part = part_of(r);
        u = score_at(&part, u);
    }
    return fmin(fmax(d->value(r->a, r->b, u), r->min), r->max);  // rounding must not exceed a limit
}

// The independent probabilities (n) of a parameter. `order` is scratch (n). False: no memory.
static bool draw_alone(const struct random_values *r, size_t *order, double *u) {
    gsl_rng *twister = gsl_rng_alloc(gsl_rng_mt19937);
    if (!twister) {
        return false;
    }
    const size_t n = (size_t)r->n;
    gsl_rng_set(twister, seed_of(r));
    for (size_t i = 0; i < n; i++) {
        order[i] = i;
    }
    if (r->plan == RANDOM_LATIN) {
        gsl_ran_shuffle(twister, order, n, sizeof *order);
    }
    for (size_t i = 0; i < n; i++) {
        u[i] = probability(twister);
        if (r->plan == RANDOM_LATIN) {
            u[i] = ((double)order[i] + u[i]) / (double)n;
        }
    }
    gsl_rng_free(twister);
    return true;
}

// Makes the independent probabilities `u` of `r` correlated. `order`, `other` and `z` are scratch
// (n). False: no memory.
static bool mix(const struct random_values *r, size_t *order, double *other, double *z, double *u) {
    const size_t n = (size_t)r->n;
    const struct random_values *from = r->before;
    for (size_t i = 0; i < n; i++) {
        z[i] = r->weight[r->n_before] * gsl_cdf_ugaussian_Pinv(u[i]);
    }
    for (int k = r->n_before - 1; k >= 0; k--, from = from->before) {
        if (r->weight[k] == 0.0) {
            continue;
        }
        if (!draw_alone(from, order, other)) {
            return false;
        }
        for (size_t i = 0; i < n; i++) {
            z[i] += r->weight[k] * gsl_cdf_ugaussian_Pinv(other[i]);
        }
    }
    if (r->plan == RANDOM_LATIN) {
        gsl_sort_index(order, z, 1, n);
        memcpy(other, u, n * sizeof *u);
        gsl_sort(other, 1, n);
        for (size_t i = 0; i < n; i++) {
            u[order[i]] = other[i];
        }
        return true;
    }
    for (size_t i = 0; i < n; i++) {
        u[i] = gsl_cdf_ugaussian_P(z[i]);
    }
    return true;
}

int random_draw(const struct random_values *r, double *value, struct error *e) {
    assert(r->n > 0 && value);
    const size_t n = (size_t)r->n;
    if (r->distribution->score && !(part_of(r).width > 0.0)) {
        return error_set(e, STATUS_INPUT, "the distribution has no values between %.6g and %.6g",
                         r->min, r->max);
    }
    size_t *order = calloc(n, sizeof *order);
    double *scratch = r->weight ? calloc(2 * n, sizeof *scratch) : NULL;
    const bool done = order && (scratch || !r->weight) && draw_alone(r, order, value) &&
                      (!r->weight || mix(r, order, scratch, scratch + n, value));
    free(scratch);
    free(order);
    for (size_t i = 0; done && i < n; i++) {
        value[i] = random_value(r, value[i]);
        if (!isfinite(value[i])) {
            return error_set(e, STATUS_INPUT, "value %zu is not finite", i + 1);
        }
    }
    return done ? STATUS_OK : error_no_memory(e);
}

// Weight k of parameter number `of`, of the chain of parameters that ends with `r`.
static double weight_of(const struct random_values *r, int of, int k) {
    while (r->n_before > of) {
        r = r->before;
    }
    return r->weight ? r->weight[k] : of == k ? 1.0 : 0.0;
}

bool random_correlate(const struct random_values *r, const double *correlation, double *weight) {
    double rest = 1.0;
    for (int k = 0; k < r->n_before; k++) {
        double sum = correlation[k];
        for (int j = 0; j < k; j++) {
            sum -= weight[j] * weight_of(r->before, k, j);
        }
        weight[k] = sum / weight_of(r->before, k, k);
        rest -= weight[k] * weight[k];
    }
    weight[r->n_before] = sqrt(fmax(rest, 0.0));
    return rest > 1e-12;  // well above the rounding of the sums
}

bool random_is_correlated(const struct random_values *r, const struct random_values *other) {
    for (const struct random_values *of = r->correlation ? r->before : NULL; of; of = of->before) {
        if (strcmp(of->name, other->name) == 0) {
            return r->correlation[of->n_before] != 0.0;
        }
    }
    return false;
}
