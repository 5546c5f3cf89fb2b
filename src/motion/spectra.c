// SPDX-License-Identifier: GPL-3.0-or-later
// Spectra of several records and their statistics. Percentiles are those of spreadsheets and numpy
// (definition 7 of Hyndman and Fan 1996, The American Statistician 50, 361).
#include <assert.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

#include "core/arena.h"
#include "jostle/spectrum.h"

static struct spectrum_point *point_at(const struct spectra *s, int series, int damping,
                                       int period) {
    const size_t row = (size_t)series * (size_t)s->n_damping + (size_t)damping;
    return &s->point[row * (size_t)s->n_period + (size_t)period];
}

const struct spectrum_point *spectra_at(const struct spectra *s, int series, int damping,
                                        int period) {
    assert(damping >= 0 && damping < s->n_damping);
    assert(period >= 0 && period < s->n_period);
    return point_at(s, series, damping, period);
}

// `value` is scratch with one value per record.
static void take_statistics(const struct spectra *s, int damping, int period, double *value) {
    static const double fraction[SPECTRA_STATISTICS] = {
        [SPECTRA_P16] = 0.16, [SPECTRA_P50] = 0.50, [SPECTRA_P84] = 0.84};
    const size_t n = (size_t)s->n_record;
    for (int q = 0; q < SPECTRUM_COUNT; q++) {
        for (int r = 0; r < s->n_record; r++) {
            value[r] = point_at(s, r, damping, period)->value[q];
        }
        gsl_sort(value, 1, n);
        point_at(s, s->n_record + SPECTRA_MEAN, damping, period)->value[q] =
            gsl_stats_mean(value, 1, n);
        for (int k = SPECTRA_P16; k < SPECTRA_STATISTICS; k++) {
            point_at(s, s->n_record + k, damping, period)->value[q] =
                gsl_stats_quantile_from_sorted_data(value, 1, n, fraction[k]);
        }
    }
}

int spectra_compute(struct spectra *s, const struct signal *ground, struct arena *a,
                    struct error *e) {
    assert(s->n_record > 0 && s->n_damping > 0 && s->n_period > 0 && ground);
    const size_t n_series = (size_t)s->n_record + SPECTRA_STATISTICS;
    s->point =
        arena_alloc(a, n_series * (size_t)s->n_damping * (size_t)s->n_period, sizeof *s->point);
    double *value = arena_alloc(a, (size_t)s->n_record, sizeof *value);
    if (!s->point || !value) {
        return error_no_memory(e);
    }
    const long n = (long)s->n_record * s->n_damping * s->n_period;
    long n_done = 0;
    for (int d = 0; d < s->n_damping; d++) {
        for (int p = 0; p < s->n_period; p++) {
            for (int r = 0; r < s->n_record; r++) {
                *point_at(s, r, d, p) = spectrum_at(&ground[r], s->period[p], s->damping[d]);
                if (s->tell) {
                    s->tell(s->context, ++n_done, n);
                }
            }
            take_statistics(s, d, p, value);
        }
    }
    return STATUS_OK;
}
