// SPDX-License-Identifier: GPL-3.0-or-later
// Hertz with a dashpot that grows with the penetration: F = k d^n (1 + q v / v0), with
// zeta = q k / v0 = 3 k (1 - e^2) / (4 v0), so q = 3 (1 - e^2) / 4.
//
// The relation is exact only near e = 1: an e of 0.65 comes out as 0.7748. The force starts and
// ends at zero, but is negative where the bodies part faster than v0 / q, which happens only when
// other forces pull them. A velocity at closure below `vmin` counts as vmin: without a floor the
// dashpot of a gentle touch would grow without bound and glue the bodies together.
#include <math.h>

#include "law/contact_list.h"
#include "law/power.h"
#include "law/restitution.h"

enum { K, E, ZETA, N, VMIN, N_ROW };
enum { STIFFNESS, EXPONENT, Q, FLOOR, N_CONSTANT };
enum { DAMPING, N_HISTORY };  // q / v0 [T/L]

static const struct row rows[N_ROW] = {
    [K] = {"k",
           ROW_NUMBER,
           ROW_REQUIRED | ROW_PER_LENGTH_POWER,
           {1, 0, 0},
           &range_positive,
           NAN,
           "impact stiffness"},
    [E] = {"e", ROW_NUMBER, ROW_ONE_OF, {0}, &restitution_range, NAN, "coefficient of restitution"},
    [ZETA] = {"zeta",
              ROW_NUMBER,
              ROW_ONE_OF,
              {0},
              &range_non_negative,
              NAN,
              "dimensionless damping q = zeta v0 / k"},
    [N] = {"n", ROW_NUMBER, ROW_POWER, {0}, &power_range, 1.5, "exponent"},
    [VMIN] = {"vmin",
              ROW_NUMBER,
              0,
              {0, 1, -1},
              &range_positive,
              1e-3,
              "velocity at closure below which v0 counts as this"},
};

static double published_q(double e) {
    return 0.75 * (1.0 - e * e);
}

static int hertz_damp_prepare(const double *value, double m_eff, double *constant,
                              struct error *e) {
    (void)m_eff, (void)e;
    constant[STIFFNESS] = value[K];
    constant[EXPONENT] = value[N];
    constant[Q] = restitution_ratio(value[E], value[ZETA], published_q);
    constant[FLOOR] = value[VMIN];
    return STATUS_OK;
}

static void hertz_damp_close(const double *c, double v0, double *history) {
    history[DAMPING] = c[Q] / fmax(v0, c[FLOOR]);
}

static struct contact_response hertz_damp_force(const double *c, const double *h, double d,
                                                double v) {
    struct contact_response spring = power_spring(c[STIFFNESS], c[EXPONENT], d);
    double factor = 1.0 + h[DAMPING] * v;
    return (struct contact_response){
        .force = spring.force * factor,
        .dfdd = spring.dfdd * factor,
        .dfdv = spring.force * h[DAMPING],
    };
}

const struct contact_law contact_hertz_damp = {
    .name = "hertz-damp",
    .summary = "Hertz with hysteresis damping",
    .formula = "F = k d^n + zeta d^n v, zeta = 3 k (1 - e^2) / (4 v0)",
    .source =
        "Muthukumar & DesRoches (2006), Earthquake Eng. Struct. Dyn. 35, 811-828, after Lankarani "
        "& Nikravesh (1990), J. Mech. Des. 112, 369-376",
    .remarks = "no jumps; delivers much more than a small e; pulls if bodies part faster than v0/q",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_V0,
    .prepare = hertz_damp_prepare,
    .close = hertz_damp_close,
    .force = hertz_damp_force,
};
