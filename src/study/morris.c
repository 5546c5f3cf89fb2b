// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/morris.h"

#include <assert.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "study/percentile.h"

enum { SEED = 1 };

static unsigned char *levels_of(const struct morris_design *d, size_t trajectory, int run) {
    const size_t n = (size_t)d->n_parameter;
    return d->level + (trajectory * (n + 1) + (size_t)run) * n;
}

int morris_draw(const struct morris_design *d, struct error *e) {
    assert(d->n_level % 2 == 0 && d->n_level <= 256);
    const unsigned long half = (unsigned long)d->n_level / 2;
    int *order = calloc((size_t)d->n_parameter, sizeof *order);
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const bool room = order && random;
    if (room) {
        gsl_rng_set(random, SEED);
    }
    for (size_t t = 0; room && t < d->n; t++) {
        for (int i = 0; i < d->n_parameter; i++) {
            order[i] = i;
            levels_of(d, t, 0)[i] = (unsigned char)gsl_rng_uniform_int(random, 2 * half);
        }
        gsl_ran_shuffle(random, order, (size_t)d->n_parameter, sizeof *order);
        for (int run = 1; run <= d->n_parameter; run++) {
            unsigned char *to = levels_of(d, t, run);
            memcpy(to, levels_of(d, t, run - 1), (size_t)d->n_parameter);
            unsigned char *moved = &to[order[run - 1]];
            *moved = (unsigned char)(*moved < half ? *moved + half : *moved - half);
        }
    }
    gsl_rng_free(random);
    free(order);
    return room ? STATUS_OK : error_no_memory(e);
}

// The effect of parameter `i` in a trajectory: that of the run in which its level changes.
static double effect_of(const struct morris_design *d, const double *demand, size_t trajectory,
                        int i, double step) {
    int run = 1;
    while (levels_of(d, trajectory, run)[i] == levels_of(d, trajectory, 0)[i]) {
        run++;
    }
    const double jump =
        step * (levels_of(d, trajectory, run)[i] - levels_of(d, trajectory, run - 1)[i]);
    const double *of_trajectory = demand + trajectory * ((size_t)d->n_parameter + 1);
    return (of_trajectory[run] - of_trajectory[run - 1]) / jump;
}

static bool is_finite(const struct morris_design *d, const double *demand, size_t trajectory) {
    const size_t n = (size_t)d->n_parameter + 1;
    bool finite = true;
    for (size_t k = 0; k < n; k++) {
        finite &= isfinite(demand[trajectory * n + k]);
    }
    return finite;
}

// Statistics of the effects (n) of one parameter. `size` is scratch (n).
static void conclude(const double *effect, size_t n, double *size, gsl_rng *random,
                     struct morris_effect *to) {
    for (size_t k = 0; k < n; k++) {
        size[k] = fabs(effect[k]);
    }
    to->mu = gsl_stats_mean(effect, 1, n);
    to->sigma = gsl_stats_sd(effect, 1, n);
    to->mu_star.value = gsl_stats_mean(size, 1, n);
    double mean[SOBOL_BOOTSTRAPS];
    for (int b = 0; b < SOBOL_BOOTSTRAPS; b++) {
        double sum = 0.0;
        for (size_t k = 0; k < n; k++) {
            sum += size[gsl_rng_uniform_int(random, n)];
        }
        mean[b] = sum / (double)n;
    }
    percentile_interval(mean, SOBOL_BOOTSTRAPS, &to->mu_star.low, &to->mu_star.high);
}

static int find_all(const struct morris_design *d, const double *demand, double step, double *room,
                    gsl_rng *random, struct morris_effect *effect, struct error *e) {
    size_t n = 0;
    gsl_rng_set(random, SEED);
    for (int i = 0; i < d->n_parameter; i++) {
        n = 0;
        for (size_t t = 0; t < d->n; t++) {
            if (is_finite(d, demand, t)) {
                room[n++] = effect_of(d, demand, t, i, step);
            }
        }
        if (n < 2) {
            return error_set(e, STATUS_FAILED, "only %zu of %zu trajectories have finite demands",
                             n, d->n);
        }
        conclude(room, n, room + d->n, random, &effect[i]);
    }
    return STATUS_OK;
}

int morris_find(const struct morris_design *d, const double *demand, double step,
                struct morris_effect *effect, size_t *n_left_out, struct error *e) {
    double *room = calloc(2 * d->n, sizeof *room);
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    const int status =
        room && random ? find_all(d, demand, step, room, random, effect, e) : error_no_memory(e);
    *n_left_out = 0;
    for (size_t t = 0; t < d->n; t++) {
        *n_left_out += !is_finite(d, demand, t);
    }
    gsl_rng_free(random);
    free(room);
    return status;
}
