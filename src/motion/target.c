// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/target.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "motion/lines.h"
#include "motion/time_series.h"

int target_read(struct arena *a, const char *path, struct target *out, struct error *e) {
    const struct time_series_column column[TIME_SERIES_COLUMNS] = {
        {"period", dimension_time, 1.0, &range_non_negative},
        {"PSA", dimension_acceleration, 0.0, &range_positive},
    };
    struct time_series points;
    const int status = time_series_read(a, path, column, &points, e);
    if (status != STATUS_OK) {
        return status;
    }
    if (points.n < 2) {
        return lines_error(e, path, 0, "a target has at least two points");
    }
    *out = (struct target){.first = points.time[0],
                           .last = points.time[points.n - 1],
                           .n = points.n,
                           .period = points.time,
                           .psa = points.value};
    return STATUS_OK;
}

int target_open(struct arena *a, const char *text, double damping, struct target *out,
                struct error *e) {
    const struct target_code *code = target_code_find(text);
    if (!code) {
        const int status = target_read(a, text, out, e);
        return status == STATUS_INPUT && strchr(text, '=') ? target_code_hint(e) : status;
    }
    *out = (struct target){.last = code->last, .code = code};
    return target_code_read(code, text, damping, out->value, e);
}

double target_at(const struct target *t, double period) {
    assert(t->code || t->n >= 2);
    if (!(period >= t->first && period <= t->last)) {
        return NAN;
    }
    if (t->code) {
        return t->code->at(t->value, period);
    }
    size_t i = 1;
    while (t->period[i] < period) {
        i++;
    }
    const double *T = t->period + i, *psa = t->psa + i;
    return T[-1] == 0.0 ? psa[-1] + (psa[0] - psa[-1]) * (period / T[0])
                        : psa[-1] * pow(psa[0] / psa[-1], log(period / T[-1]) / log(T[0] / T[-1]));
}

// The factor f of a record minimises the sum over the periods of (ln target - ln(f PSA))^2:
//     ln f = mean of ln(target / PSA)
// (PEER 2010, Technical Report for the PEER Ground Motion Database Web Application, with equal
// weights). The misfit is the root of the mean square that remains: a difference of shape.

static double psa(const struct spectra *s, int record, int period) {
    return spectra_at(s, record, 0, period)->value[SPECTRUM_PSA];
}

int target_match(struct match *m, const struct spectra *s, const double *goal, struct arena *a,
                 struct error *e) {
    assert(s->n_record > 0 && s->n_period > 0 && goal);
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
        double sum = 0.0, squares = 0.0;
        for (int p = 0; p < s->n_period; p++) {
            sum += log(goal[p] / psa(s, r, p));
        }
        const double mean = sum / s->n_period;
        for (int p = 0; p < s->n_period; p++) {
            const double left = log(goal[p] / psa(s, r, p)) - mean;
            squares += left * left;
        }
        m->factor[r] = exp(mean);
        m->misfit[r] = sqrt(squares / s->n_period);
    }
    for (int p = 0; p < s->n_period; p++) {
        double sum = 0.0;
        for (int r = 0; r < s->n_record; r++) {
            sum += m->factor[r] * psa(s, r, p);
        }
        const struct match_ratio ratio =
            (struct match_ratio){s->period[p], sum / s->n_record / goal[p]};
        m->least = ratio.value < m->least.value ? ratio : m->least;
        m->largest = ratio.value > m->largest.value ? ratio : m->largest;
    }
    return STATUS_OK;
}
