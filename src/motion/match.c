// SPDX-License-Identifier: GPL-3.0-or-later
// The factor f of a record makes the sum over the periods of (ln target - ln(f PSA))^2 least:
//     ln f = mean of ln(target / PSA)
// (PEER 2010, Technical Report for the PEER Ground Motion Database Web Application, with equal
// weights). What is left of the square, its root of the mean, is the misfit: a difference of shape.
#include "motion/match.h"

#include <math.h>

#include "core/arena.h"

static double psa(const struct spectra *s, int record, int period) {
    return spectra_at(s, record, 0, period)->value[SPECTRUM_PSA];
}

static void fit_record(struct match *m, const struct spectra *s, const double *goal, int record) {
    double sum = 0.0, squares = 0.0;
    for (int p = 0; p < s->n_period; p++) {
        sum += log(goal[p] / psa(s, record, p));
    }
    const double mean = sum / s->n_period;
    for (int p = 0; p < s->n_period; p++) {
        const double left = log(goal[p] / psa(s, record, p)) - mean;
        squares += left * left;
    }
    m->factor[record] = exp(mean);
    m->misfit[record] = sqrt(squares / s->n_period);
}

static struct match_ratio ratio_at(const struct match *m, const struct spectra *s,
                                   const double *goal, int period) {
    double sum = 0.0;
    for (int r = 0; r < s->n_record; r++) {
        sum += m->factor[r] * psa(s, r, period);
    }
    return (struct match_ratio){s->period[period], sum / s->n_record / goal[period]};
}

int match_compute(struct match *m, const struct spectra *s, const double *goal, struct arena *a,
                  struct error *e) {
    *m = (struct match){
        .factor = arena_alloc(a, (size_t)s->n_record, sizeof *m->factor),
        .misfit = arena_alloc(a, (size_t)s->n_record, sizeof *m->misfit),
        .least.value = INFINITY,
        .largest.value = -INFINITY,
    };
    if (!m->factor || !m->misfit) {
        return error_no_memory(e);
    }
    for (int r = 0; r < s->n_record; r++) {
        fit_record(m, s, goal, r);
    }
    for (int p = 0; p < s->n_period; p++) {
        const struct match_ratio ratio = ratio_at(m, s, goal, p);
        m->least = ratio.value < m->least.value ? ratio : m->least;
        m->largest = ratio.value > m->largest.value ? ratio : m->largest;
    }
    return STATUS_OK;
}
