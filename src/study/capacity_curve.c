// SPDX-License-Identifier: GPL-3.0-or-later
// The demand of a sample between the intensities that were run.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_spline.h>
#include <math.h>

#include "core/root.h"
#include "study/capacity.h"

static const double TOLERANCE = 1e-12;  // relative, of the crossing

// The spline of the demand, less the limit.
struct excess {
    const gsl_spline *spline;
    double limit;
};

static double excess_at(double x, void *context) {
    const struct excess *s = context;
    return gsl_spline_eval(s->spline, x, NULL) - s->limit;
}

// Where the spline through `n` points crosses the limit between x[i - 1] and x[i]; NAN: no memory.
static double on_spline(const double *x, const double *y, int n, int i, double limit) {
    gsl_spline *spline = gsl_spline_alloc(gsl_interp_cspline, (size_t)n);
    double at = NAN;
    if (spline && gsl_spline_init(spline, x, y, (size_t)n) == GSL_SUCCESS) {
        struct excess s = {spline, limit};
        at = root_find(excess_at, &s, x[i - 1], x[i], TOLERANCE);
    }
    gsl_spline_free(spline);
    return at;
}

double capacity_curve_crossing(const struct capacity *c, double limit, enum capacity_curve curve) {
    double x[CAPACITY_POINTS_MAX] = {0.0}, y[CAPACITY_POINTS_MAX] = {0.0};
    int n = 0, over = 0;
    while (!c->point[over].exceeded) {
        over++;
    }
    const struct capacity_point *low = &c->point[over - 1], *high = &c->point[over];
    // A demand that is at the limit below the crossing, such as 0 collapses, jumps.
    if (curve == CAPACITY_MIDDLE || isinf(high->value) || low->value == limit) {
        return sqrt(low->intensity * high->intensity);
    }
    for (int i = 0; i < c->n_point && isfinite(c->point[i].value); i++) {
        x[n] = c->point[i].intensity;
        y[n++] = c->point[i].value;
    }
    const double share = (limit - low->value) / (high->value - low->value);
    const double line = low->intensity + share * (high->intensity - low->intensity);
    const double spline =
        curve == CAPACITY_SPLINE && n >= 3 ? on_spline(x, y, n, over, limit) : line;
    return isnan(spline) ? line : spline;
}
