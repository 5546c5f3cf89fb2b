// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/restitution.h"

#include <float.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_log.h>
#include <math.h>

#include "core/root.h"

const struct range restitution_range = {.min = 1e-6, .max = 1.0, .text = ">= 1e-6 and <= 1"};

double restitution_kelvin_voigt(double e) {
    double l = fabs(log(e));
    return l / sqrt(M_PI * M_PI + l * l);
}

double restitution_lankarani_nikravesh(double e) {
    return 0.75 * (1.0 - e * e);
}

// q (1 + e) - ln(1 + q) + ln(1 - e q), written with ln(1 + x) - x: small q then lose no digits.
static double exact_q_residual(double q, void *context) {
    double e = *(const double *)context;
    return gsl_sf_log_1plusx_mx(-e * q) - gsl_sf_log_1plusx_mx(q);
}

double restitution_exact_q(double e) {
    double low = restitution_lankarani_nikravesh(e);  // always too small
    double high = (1.0 - DBL_EPSILON) / e;
    if (!(exact_q_residual(low, &e) > 0.0)) {
        return low;
    }
    if (!(exact_q_residual(high, &e) < 0.0)) {
        return high;
    }
    return root_find(exact_q_residual, &e, low, high, 4.0 * DBL_EPSILON);
}

// (share(q) - required share) / 2, written with ln(1 + q) - q: small q then lose no digits.
static double stored_residual(double q, void *context) {
    double share = *(const double *)context;
    return -gsl_sf_log_1plusx_mx(q) / (q * q) - share / 2.0;
}

double restitution_stored_q(double share) {
    double low = 1.5 * (1.0 - share);  // because share > 1 - 2 q / 3
    double high = 2.0 / share;         // because share < 2 / q
    if (low == 0.0 || !(stored_residual(low, &share) > 0.0)) {
        return low;
    }
    return root_find(stored_residual, &share, low, high, 4.0 * DBL_EPSILON);
}

static double release_residual(double q, void *context) {
    double e = *(const double *)context;
    return gsl_sf_log_1plusx_mx(-e * q) + q * q / 2.0;
}

double restitution_release_q(double e) {
    double low = (1.0 - e) * (1.0 + e) / e;  // where the residual is largest
    double high = (1.0 - DBL_EPSILON) / e;
    if (low == 0.0) {
        return 0.0;
    }
    return release_residual(high, &e) < 0.0
               ? root_find(release_residual, &e, low, high, 4.0 * DBL_EPSILON)
               : high;
}

// a / tan a with cos a = zeta. Where a and tan a tend to 0, a series in tan^2 a.
static double phase_over_tangent(double zeta) {
    double square = (1.0 - zeta) * (1.0 + zeta);
    double x = square / (zeta * zeta);
    if (fabs(x) < 1e-4) {
        return 1.0 - x * (1.0 / 3.0 - x * (1.0 / 5.0 - x / 7.0));
    }
    double angle = x > 0.0 ? acos(zeta) : acosh(zeta);
    return angle * zeta / sqrt(fabs(square));
}

static double approach_residual(double zeta, void *context) {
    return phase_over_tangent(zeta) - *(const double *)context;
}

// The ratio with a / tan a = decay.
static double ratio_of_decay(double decay) {
    double low = decay * M_2_PI;  // a / tan a <= zeta pi / 2
    double high = low;
    if (decay == 0.0 || !(approach_residual(low, &decay) < 0.0)) {
        return low;
    }
    while (approach_residual(high, &decay) <= 0.0) {
        high *= 2.0;
    }
    return root_find(approach_residual, &decay, low, high, 4.0 * DBL_EPSILON);
}

double restitution_approach(double e) {
    return ratio_of_decay(fabs(log(e)));
}

double restitution_no_tension(double e) {
    return ratio_of_decay(fabs(log(e)) / 2.0);
}

double restitution_ratio(double e, double zeta, double (*relation)(double e)) {
    return isnan(e) ? zeta : relation(e);
}

const struct row restitution_dashpot_rows[DASHPOT_ROWS] = {
    [DASHPOT_K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN,
                   "impact stiffness"},
    [DASHPOT_E] = RESTITUTION_ROW,
    [DASHPOT_ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
                      "damping ratio"},
};

void restitution_dashpot(const double *value, double m_eff, double (*relation)(double e),
                         double *constant) {
    double zeta = restitution_ratio(value[DASHPOT_E], value[DASHPOT_ZETA], relation);
    constant[DASHPOT_STIFFNESS] = value[DASHPOT_K];
    constant[DASHPOT_COEFFICIENT] = 2.0 * zeta * sqrt(value[DASHPOT_K] * m_eff);
}

int restitution_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)e;
    restitution_dashpot(value, m_eff, restitution_kelvin_voigt, constant);
    return STATUS_OK;
}
