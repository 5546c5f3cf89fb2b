// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/target.h"

#include <math.h>

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
    *out = (struct target){points.n, points.time, points.value};
    return STATUS_OK;
}

double target_at(const struct target *t, double period) {
    if (!(period >= t->period[0] && period <= t->period[t->n - 1])) {
        return NAN;
    }
    size_t i = 1;
    while (t->period[i] < period) {
        i++;
    }
    const double *T = t->period + i, *psa = t->psa + i;
    return T[-1] == 0.0 ? psa[-1] + (psa[0] - psa[-1]) * (period / T[0])
                        : psa[-1] * pow(psa[0] / psa[-1], log(period / T[-1]) / log(T[0] / T[-1]));
}
