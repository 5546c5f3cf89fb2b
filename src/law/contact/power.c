// SPDX-License-Identifier: GPL-3.0-or-later
// A power spring of any exponent, elastic or with the dashpot that delivers e exactly:
// F = k d^n (1 + q v / v0), 1 + e = (1/q) ln((1 + q) / (1 - e q)); q = 0 without -e and -zeta.
#include "law/power.h"

#include "law/contact_list.h"
#include "law/hysteresis.h"
#include "law/restitution.h"

static const struct row rows[HYSTERESIS_ROWS] = {
    [HYSTERESIS_K] = POWER_STIFFNESS_ROW("impact stiffness"),
    [HYSTERESIS_E] = {"e", ROW_NUMBER, 0, OF_NONE, &restitution_range, NAN,
                      "coefficient of restitution; elastic without -e and -zeta"},
    [HYSTERESIS_ZETA] = {"zeta", ROW_NUMBER, 0, OF_NONE, &range_non_negative, NAN,
                         "dimensionless damping q = zeta v0 / k, in place of -e"},
    [HYSTERESIS_VMIN] = HYSTERESIS_VMIN_ROW,
    [HYSTERESIS_N] = {"n", ROW_NUMBER, ROW_REQUIRED | ROW_POWER, OF_NONE, &power_range, NAN,
                      "exponent"},
};

static int power_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    double restitution = value[HYSTERESIS_E];
    double zeta = value[HYSTERESIS_ZETA];
    if (!isnan(restitution) && !isnan(zeta)) {
        return error_set(e, STATUS_INPUT, "-e and -zeta cannot stand together");
    }
    const double all[HYSTERESIS_ROWS] = {
        [HYSTERESIS_K] = value[HYSTERESIS_K],
        [HYSTERESIS_E] = isnan(zeta) && isnan(restitution) ? 1.0 : restitution,
        [HYSTERESIS_ZETA] = zeta,
        [HYSTERESIS_VMIN] = value[HYSTERESIS_VMIN],
        [HYSTERESIS_N] = value[HYSTERESIS_N],
    };
    return hysteresis_prepare(all, restitution_exact_q, constant, e);
}

const struct contact_law contact_power = {
    .name = "power",
    .summary = "spring of any exponent, with or without hysteresis damping",
    .formula = "F = k d^n (1 + q v / v0), 1 + e = (1/q) ln((1 + q) / (1 - e q))",
    .source = "Hunt & Crossley (1975), J. Appl. Mech. 42, 440-445; relation derived from the "
              "energies of both halves of the impact",
    .remarks = "for faces between flat and curved; no jumps; delivers e exactly; needs v0, and "
               "pulls if bodies part faster than v0/q",
    .example = "-k 30e9N/m^2 -n 2 -e 0.65",
    .row = rows,
    .n_row = HYSTERESIS_ROWS,
    .n_constant = HYSTERESIS_CONSTANTS,
    .n_history = HYSTERESIS_HISTORY,
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_V0 | CONTACT_SMOOTH,
    .prepare = power_prepare,
    .close = hysteresis_close,
    .force = hysteresis_force,
    .exact = restitution_exact_q,
};
