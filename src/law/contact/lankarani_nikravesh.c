// SPDX-License-Identifier: GPL-3.0-or-later
// Lankarani & Nikravesh: F = k d^n (1 + q v / v0), q = 3 (1 - e^2) / 4, from the energy lost in a
// contact that is nearly elastic. For buildings it is known as hertz-damp, which is the same.
#include "law/contact_list.h"
#include "law/hysteresis.h"
#include "law/restitution.h"

static int lankarani_nikravesh_prepare(const double *value, double m_eff, double *constant,
                                       struct error *e) {
    (void)m_eff;
    return hysteresis_prepare(value, restitution_lankarani_nikravesh, constant, e);
}

const struct contact_law contact_lankarani_nikravesh = {
    .name = "lankarani-nikravesh",
    .summary = "Hertz with hysteresis damping, as in multibody dynamics",
    .formula = "F = k d^n (1 + (3 (1 - e^2) / 4) v / v0)",
    .source = "Lankarani & Nikravesh (1990), J. Mech. Des. 112, 369-376",
    .remarks = "the same force as hertz-damp, for those who know it by this name: for curved faces "
               "and e near 1; needs v0, and pulls if bodies part faster than v0/q",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = hysteresis_rows,
    .n_row = HYSTERESIS_ROWS,
    .n_constant = HYSTERESIS_CONSTANTS,
    .n_history = HYSTERESIS_HISTORY,
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_V0 | CONTACT_SMOOTH,
    .prepare = lankarani_nikravesh_prepare,
    .close = hysteresis_close,
    .force = hysteresis_force,
    .exact = restitution_exact_q,
};
