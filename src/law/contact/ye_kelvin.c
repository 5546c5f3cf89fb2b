// SPDX-License-Identifier: GPL-3.0-or-later
// Kelvin-Voigt with a dashpot that grows with the penetration: F = k d + zeta d v,
// zeta = 3 k (1 - e) / (2 e v0), so F = k d (1 + q v / v0) with q = 3 (1 - e) / (2 e).
//
// One review prints zeta v for the damping force. 0.65 comes out as 0.6457, 0.4 as 0.3796.
#include "law/contact_list.h"
#include "law/hysteresis.h"
#include "law/restitution.h"

enum { K, E, ZETA, VMIN, N_ROW };

static const struct row rows[N_ROW] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN, "impact stiffness"},
    [E] = RESTITUTION_ROW,
    [ZETA] = HYSTERESIS_ZETA_ROW,
    [VMIN] = HYSTERESIS_VMIN_ROW,
};

static double published_q(double e) {
    return 3.0 * (1.0 - e) / (2.0 * e);
}

static int ye_kelvin_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    const double all[HYSTERESIS_ROWS] = {
        [HYSTERESIS_K] = value[K],       [HYSTERESIS_E] = value[E], [HYSTERESIS_ZETA] = value[ZETA],
        [HYSTERESIS_VMIN] = value[VMIN], [HYSTERESIS_N] = 1.0,
    };
    return hysteresis_prepare(all, published_q, constant, e);
}

const struct contact_law contact_ye_kelvin = {
    .name = "ye-kelvin",
    .summary = "linear spring with hysteresis damping",
    .formula = "F = k d + zeta d v, zeta = 3 k (1 - e) / (2 e v0)",
    .source = "Ye, Li & Zhu (2009), Earthquake Eng. Eng. Vib. 8, 433-446",
    .remarks = "for flat faces; no jumps; delivers a little less than e; needs v0, and pulls if "
               "bodies part faster than v0/q",
    .example = "-k 93.5MN/m -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = HYSTERESIS_CONSTANTS,
    .n_history = HYSTERESIS_HISTORY,
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_V0 | CONTACT_SMOOTH,
    .prepare = ye_kelvin_prepare,
    .close = hysteresis_close,
    .force = hysteresis_force,
    .exact = restitution_exact_q,
};
