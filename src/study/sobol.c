// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/sobol.h"

#include <gsl/gsl_rng.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "study/percentile.h"

enum { SEED = 1 };

// The rows that count, and which of them a bootstrap has drawn.
struct rows {
    const struct sobol_runs *runs;
    size_t n, *row, *drawn;  // (n) heap
    double *effect;          // (n) heap
};

static double demand_of(const struct rows *r, size_t k, int column) {
    const size_t n_column = (size_t)r->runs->n_parameter + SOBOL_PARAMETER;
    return r->runs->demand[r->row[k] * n_column + (size_t)column];
}

// Mean and variance of the drawn rows of A and B.
static void moments(const struct rows *r, double *mean, double *variance) {
    double sum = 0.0, squares = 0.0;
    for (size_t k = 0; k < r->n; k++) {
        sum += demand_of(r, r->drawn[k], SOBOL_A) + demand_of(r, r->drawn[k], SOBOL_B);
    }
    *mean = sum / (2.0 * (double)r->n);
    for (size_t k = 0; k < r->n; k++) {
        squares += pow(demand_of(r, r->drawn[k], SOBOL_A) - *mean, 2.0) +
                   pow(demand_of(r, r->drawn[k], SOBOL_B) - *mean, 2.0);
    }
    *variance = squares / (2.0 * (double)r->n);
}

// The shares of parameter `i`, first order and total.
static void shares(const struct rows *r, int i, double *first, double *total) {
    double mean, variance, alone = 0.0, left = 0.0;
    moments(r, &mean, &variance);
    for (size_t k = 0; k < r->n; k++) {
        const double a = demand_of(r, r->drawn[k], SOBOL_A);
        const double b = demand_of(r, r->drawn[k], SOBOL_B);
        const double other = demand_of(r, r->drawn[k], SOBOL_PARAMETER + i);
        alone += (b - mean) * (other - a);
        left += pow(a - other, 2.0);
    }
    *first = variance > 0.0 ? alone / ((double)r->n * variance) : (double)NAN;
    *total = variance > 0.0 ? left / (2.0 * (double)r->n * variance) : (double)NAN;
}

static void find_share(const struct rows *r, int i, gsl_rng *random, struct sobol_share *to) {
    double first[SOBOL_BOOTSTRAPS], total[SOBOL_BOOTSTRAPS];
    const double *step = r->runs->step + (size_t)i * r->runs->n;
    for (size_t k = 0; k < r->n; k++) {
        r->drawn[k] = k;
        r->effect[k] =
            (demand_of(r, k, SOBOL_PARAMETER + i) - demand_of(r, k, SOBOL_A)) / step[r->row[k]];
    }
    shares(r, i, &to->first.value, &to->total.value);
    to->scatter = gsl_stats_sd(r->effect, 1, r->n);
    to->effect = gsl_stats_absdev_m(r->effect, 1, r->n, 0.0);
    for (int b = 0; b < SOBOL_BOOTSTRAPS; b++) {
        for (size_t k = 0; k < r->n; k++) {
            r->drawn[k] = gsl_rng_uniform_int(random, r->n);
        }
        shares(r, i, &first[b], &total[b]);
    }
    percentile_interval(first, SOBOL_BOOTSTRAPS, &to->first.low, &to->first.high);
    percentile_interval(total, SOBOL_BOOTSTRAPS, &to->total.low, &to->total.high);
}

// Takes the rows in which all runs have a finite demand.
static void take_rows(struct rows *r) {
    const size_t n_column = (size_t)r->runs->n_parameter + SOBOL_PARAMETER;
    for (size_t k = 0; k < r->runs->n; k++) {
        bool finite = true;
        for (size_t column = 0; column < n_column; column++) {
            finite &= isfinite(r->runs->demand[k * n_column + column]);
        }
        if (finite) {
            r->drawn[r->n] = r->n;
            r->row[r->n++] = k;
        }
    }
}

static int find_all(struct rows *r, gsl_rng *random, struct sobol_share *share,
                    struct sobol_summary *out, struct error *e) {
    take_rows(r);
    if (r->n < 2) {
        return error_set(e, STATUS_FAILED, "only %zu of %zu rows of runs have numbers", r->n,
                         r->runs->n);
    }
    gsl_rng_set(random, SEED);
    moments(r, &out->mean, &out->deviation);
    out->deviation = sqrt(out->deviation);
    out->n_left_out = r->runs->n - r->n;
    for (int i = 0; i < r->runs->n_parameter; i++) {
        find_share(r, i, random, &share[i]);
    }
    return STATUS_OK;
}

int sobol_find(const struct sobol_runs *runs, struct sobol_share *share, struct sobol_summary *out,
               struct error *e) {
    struct rows r = {.runs = runs,
                     .row = calloc(runs->n, sizeof *r.row),
                     .drawn = calloc(runs->n, sizeof *r.drawn),
                     .effect = calloc(runs->n, sizeof *r.effect)};
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const bool room = r.row && r.drawn && r.effect && random;
    const int status = room ? find_all(&r, random, share, out, e) : error_no_memory(e);
    gsl_rng_free(random);
    free(r.effect);
    free(r.drawn);
    free(r.row);
    return status;
}
