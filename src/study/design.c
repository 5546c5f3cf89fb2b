// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/design.h"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_rng.h>
#include <math.h>

#include "deck/random.h"

enum { SEED = 1, SOBOL_DIMENSIONS_MAX = 40 };

long design_count_sets(const struct sensitivity_request *q, const struct sensitivity *s) {
    return q->method == SENSITIVITY_VARIANCE ? (long)(s->n_parameter + SOBOL_PARAMETER) * s->n_row
           : q->method == SENSITIVITY_MORRIS ? (s->n_parameter + 1L) * s->n_row
                                             : 1 + 2L * s->n_parameter;
}

size_t design_at(const struct design *d, long set, int i) {
    size_t level = set == 1 + 2L * i ? 1 : set == 2 + 2L * i ? 2 : 0;
    if (d->request->method == SENSITIVITY_VARIANCE) {
        const long row = set / (d->of->n_parameter + SOBOL_PARAMETER);
        const long column = set % (d->of->n_parameter + SOBOL_PARAMETER);
        const bool from_b = column == SOBOL_B || column == SOBOL_PARAMETER + i;
        level = (size_t)(row + (from_b ? d->of->n_row : 0));
    } else if (d->request->method == SENSITIVITY_MORRIS) {
        level = d->morris.level[set * d->of->n_parameter + i];
    }
    return (size_t)i * (size_t)d->n_level + level;
}

// Two samples from one sequence: levels 0 to n - 1 and n to 2 n - 1. False: no memory.
static bool fill_samples(struct design *d) {
    enum { DIMENSIONS_MAX = 2 * PLAN_PAIRED_MAX };
    const int n = 2 * d->of->n_parameter;
    double point[DIMENSIONS_MAX] = {0.0}, shift[DIMENSIONS_MAX];
    const bool quasi = n <= SOBOL_DIMENSIONS_MAX;
    gsl_qrng *sequence = quasi ? gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)n) : NULL;
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const bool room = random && (sequence || !quasi);
    if (room) {
        gsl_rng_set(random, SEED);
    }
    for (int k = 0; room && k < n; k++) {
        shift[k] = gsl_rng_uniform_pos(random);
    }
    for (long row = 0; room && row < d->of->n_row; row++) {
        if (quasi) {
            gsl_qrng_get(sequence, point);
        }
        for (int k = 0; k < n; k++) {
            const int i = k % d->of->n_parameter, half = k / d->of->n_parameter;
            d->u[(long)i * d->n_level + row + half * d->of->n_row] =
                quasi ? fmod(point[k] + shift[k], 1.0) : gsl_rng_uniform_pos(random);
        }
    }
    gsl_rng_free(random);
    gsl_qrng_free(sequence);
    return room;
}

static void fill_levels(struct design *d) {
    const double share = d->request->share, most = d->n_level - 1.0;
    const bool morris = d->request->method == SENSITIVITY_MORRIS;
    for (int i = 0; i < d->of->n_parameter; i++) {
        for (int k = 0; k < d->n_level; k++) {
            d->u[(long)i * d->n_level + k] = morris   ? share + (1.0 - 2.0 * share) * (k / most)
                                             : k == 0 ? 0.5
                                             : k == 1 ? share
                                                      : 1.0 - share;
        }
    }
}

static int find_values(struct design *d, struct error *e) {
    for (int i = 0; i < d->of->n_parameter; i++) {
        const struct sweep *s = d->of->parameter[i];
        for (int k = 0; k < d->n_level; k++) {
            const long at = (long)i * d->n_level + k;
            d->value[at] = random_value(s->law, d->u[at]);
            if (!isfinite(d->value[at])) {
                return error_set(e, STATUS_INPUT,
                                 "'%s' is infinite at the probability %g; --share must be > 0",
                                 s->name, d->u[at]);
            }
        }
    }
    return STATUS_OK;
}

int design_init(struct design *d, const struct sensitivity_request *q, const struct sensitivity *s,
                struct arena *a, struct error *e) {
    const size_t n_parameter = (size_t)s->n_parameter;
    *d = (struct design){.request = q, .of = s, .n_set = design_count_sets(q, s)};
    d->n_level = q->method == SENSITIVITY_VARIANCE ? (int)(2 * s->n_row)
                 : q->method == SENSITIVITY_MORRIS ? q->n_level
                                                   : 3;
    d->u = arena_alloc(a, n_parameter * (size_t)d->n_level, sizeof *d->u);
    d->value = arena_alloc(a, n_parameter * (size_t)d->n_level, sizeof *d->value);
    if (!d->u || !d->value) {
        return error_no_memory(e);
    }
    if (q->method == SENSITIVITY_VARIANCE) {
        return fill_samples(d) ? find_values(d, e) : error_no_memory(e);
    }
    fill_levels(d);
    int status = find_values(d, e);
    if (status == STATUS_OK && q->method == SENSITIVITY_MORRIS) {
        d->morris = (struct morris_design){
            .n_parameter = s->n_parameter,
            .n_level = q->n_level,
            .n = (size_t)s->n_row,
            .level = arena_alloc(a, (size_t)d->n_set * n_parameter, sizeof *d->morris.level)};
        status = d->morris.level ? morris_draw(&d->morris, e) : error_no_memory(e);
    }
    return status;
}
