// SPDX-License-Identifier: GPL-3.0-or-later
// Hunt & Crossley with the exact relation between q and e: F = k d^n (1 + q v / v0) with
//     1 + e = (1/q) ln((1 + q) / (1 - e q)).
// n = 1 for flat faces, 3/2 for curved ones; e does not depend on n.
#include "law/contact_list.h"
#include "law/hysteresis.h"
#include "law/restitution.h"

static int hunt_crossley_prepare(const double *value, double m_eff, double *constant,
                                 struct error *e) {
    (void)m_eff;
    double n = value[HYSTERESIS_N];
    if (n != 1.0 && n != 1.5) {
        return error_set(e, STATUS_INPUT,
                         "n is %.6g; it must be 1 or 1.5 (the law power takes any)", n);
    }
    return hysteresis_prepare(value, restitution_exact_q, constant, e);
}

const struct contact_law contact_hunt_crossley = {
    .name = "hunt-crossley",
    .summary = "spring with hysteresis damping, exact restitution",
    .formula = "F = k d^n + zeta d^n v, n = 1 or 3/2, 1 + e = (1/q) ln((1 + q) / (1 - e q)), "
               "q = zeta v0 / k",
    .source = "Hunt & Crossley (1975), J. Appl. Mech. 42, 440-445; relation derived from the "
              "energies of both halves of the impact",
    .remarks = "for flat (n = 1) or curved faces; no jumps; delivers e exactly; needs v0, and "
               "pulls if bodies part faster than v0/q",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = hysteresis_rows,
    .n_row = HYSTERESIS_ROWS,
    .n_constant = HYSTERESIS_CONSTANTS,
    .n_history = HYSTERESIS_HISTORY,
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_V0 | CONTACT_SMOOTH,
    .prepare = hunt_crossley_prepare,
    .close = hysteresis_close,
    .force = hysteresis_force,
    .exact = restitution_exact_q,
};
