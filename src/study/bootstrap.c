// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/bootstrap.h"

#include <gsl/gsl_rng.h>
#include <stdlib.h>
#include <string.h>

#include "study/percentile.h"

struct draws {
    int *weight;                  // (n_unit)
    double *median, *dispersion;  // (n_draw)
    gsl_rng *random;
};

// Draws as many units as there are, stratum by stratum.
static void draw(const struct bootstrap_request *q, struct draws *d) {
    memset(d->weight, 0, (size_t)q->n_unit * sizeof *d->weight);
    for (int first = 0, end = 0; first < q->n_unit; first = end) {
        for (end = first + 1;
             end < q->n_unit && (!q->stratum || q->stratum[end] == q->stratum[first]); end++) {
        }
        for (int i = first; i < end; i++) {
            const unsigned long n = (unsigned long)(end - first);
            d->weight[first + (int)gsl_rng_uniform_int(d->random, n)]++;
        }
    }
}

static int fit_all(const struct bootstrap_request *q, struct draws *d, struct bootstrap *out,
                   struct error *e) {
    gsl_rng_set(d->random, (unsigned long)q->seed);
    for (int i = 0; i < q->n_draw; i++) {
        struct fragility f;
        draw(q, d);
        const int status = q->fit(q->context, d->weight, &f, e);
        if (status != STATUS_OK && status != STATUS_FAILED) {
            return status;
        }
        if (status == STATUS_OK && f.outcome == FRAGILITY_FITTED) {
            d->median[out->n_fitted] = f.median;
            d->dispersion[out->n_fitted++] = f.dispersion;
        }
    }
    const size_t n = (size_t)out->n_fitted;
    percentile_interval(d->median, n, &out->median[0], &out->median[1]);
    percentile_interval(d->dispersion, n, &out->dispersion[0], &out->dispersion[1]);
    return STATUS_OK;
}

int bootstrap_run(const struct bootstrap_request *q, struct bootstrap *out, struct error *e) {
    const size_t n_draw = (size_t)q->n_draw + 1;
    struct draws d = {.weight = calloc((size_t)q->n_unit + 1, sizeof *d.weight),
                      .median = malloc(n_draw * sizeof *d.median),
                      .dispersion = malloc(n_draw * sizeof *d.dispersion),
                      .random = gsl_rng_alloc(gsl_rng_mt19937)};
    const bool room = d.weight && d.median && d.dispersion && d.random;
    *out = (struct bootstrap){.seed = q->seed, .n_draw = q->n_draw};
    const int status = room ? fit_all(q, &d, out, e) : error_no_memory(e);
    free(d.weight);
    free(d.median);
    free(d.dispersion);
    gsl_rng_free(d.random);
    return status;
}

int bootstrap_fit_records(void *context, const int *weight, struct fragility *out,
                          struct error *e) {
    const struct bootstrap_records *r = context;
    int n = 0;
    for (int i = 0; i < r->n; i++) {
        for (int k = 0; k < (weight ? weight[i] : 1); k++) {
            r->drawn[n++] = r->record[i];
        }
    }
    return fragility_fit_records(r->drawn, n, out, e);
}
