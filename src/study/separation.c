// SPDX-License-Identifier: GPL-3.0-or-later
// Of two linear buildings under the same stationary random ground motion, the variance of the
// relative displacement is s_A^2 + s_B^2 - 2 rho s_A s_B. With peaks in place of standard
// deviations, and first modes only, that is the double difference combination
//
//   s = sqrt(uA^2 + uB^2 - 2 rho uA uB)
//
//   rho = 8 sqrt(zA zB) (zA + r zB) r^(3/2)
//         / ((1 - r^2)^2 + 4 zA zB r (1 + r^2) + 4 (zA^2 + zB^2) r^2),   r = TA / TB = wB / wA
//
// Der Kiureghian (1980), Structural response to stationary excitation, J. Eng. Mech. Div. ASCE 106,
// 1195-1213: rho. Jeng, Kasai & Maison (1992), A spectral difference method to estimate building
// separations to avoid pounding, Earthquake Spectra 8, 201-223, and Penzien (1997), Evaluation of
// building separation distance required to prevent pounding during strong earthquakes, Earthquake
// Eng. Struct. Dyn. 26, 849-858: its use for pounding.
#include "study/separation.h"

#include <math.h>

static double absolute_sum(double left, double right, double rho) {
    (void)rho;
    return left + right;
}

static double root_of_squares(double left, double right, double rho) {
    (void)rho;
    return hypot(left, right);
}

static double reduced_root(double left, double right, double rho) {
    (void)rho;
    return 0.7 * hypot(left, right);
}

static double double_difference(double left, double right, double rho) {
    const double square = left * left + right * right - 2.0 * rho * left * right;
    return square < 0.0 ? 0.0 : sqrt(square);  // rounding may leave a trace below 0; NAN stays
}

const struct separation_rule separation_rules[SEPARATION_RULES] = {
    {"absolute_sum", "abs. sum", "uA + uB",
     "both set back from a property line: ASCE/SEI 7-16, 12.12.3; EN 1998-1:2004, 4.4.2.7(2)a",
     absolute_sum},
    {"srss", "SRSS", "sqrt(uA^2 + uB^2)",
     "on one property: ASCE/SEI 7-16, 12.12.3; EN 1998-1:2004, 4.4.2.7(2)b", root_of_squares},
    {"srss_level", "0.7 SRSS", "0.7 sqrt(uA^2 + uB^2)",
     "the same if all floors are at the same levels: EN 1998-1:2004, 4.4.2.7(3)", reduced_root},
    {"double_difference", "double diff.", "sqrt(uA^2 + uB^2 - 2 rho uA uB)",
     "Jeng, Kasai & Maison (1992); Penzien (1997); rho: Der Kiureghian (1980)", double_difference},
};

double separation_correlation(const double period[2], const double damping[2]) {
    const double a = damping[0], b = damping[1];
    if (!isfinite(period[0]) || !isfinite(period[1])) {
        return NAN;
    }
    if (period[0] == period[1] && a == b) {
        return 1.0;  // of no damping as well, where the formula is 0 / 0
    }
    if (a < 0.0 || b < 0.0) {
        return NAN;  // such a response is never stationary
    }
    const double r = period[0] / period[1], square = r * r, away = 1.0 - square;
    return 8.0 * sqrt(a * b) * (a + r * b) * r * sqrt(r) /
           (away * away + 4.0 * a * b * r * (1.0 + square) + 4.0 * (a * a + b * b) * square);
}

double separation_by(const struct separation_rule *rule, const struct separation_ends *ends) {
    const double left = ends->displacement[0], right = ends->displacement[1];
    const double rho =
        left > 0.0 && right > 0.0 ? separation_correlation(ends->period, ends->damping) : 0.0;
    return rule->separation(left, right, rho);
}
