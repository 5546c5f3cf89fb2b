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
