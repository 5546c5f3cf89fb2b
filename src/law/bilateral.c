// SPDX-License-Identifier: GPL-3.0-or-later
// Spring and damper that push and pull: F = k d + c |v|^a sign(v). d and v may have either sign.
// For a < 1 the force has an infinite slope at v = 0.
#include "law/bilateral.h"

#include <math.h>

static const struct range exponent_range = {
    .min = 0.0, .max = 3.0, .min_open = true, .text = "> 0 and <= 3"};

const struct row bilateral_rows[BILATERAL_ROWS] = {
    [BILATERAL_STIFFNESS] = {"stiffness", ROW_NUMBER, 0, OF_STIFFNESS, &range_non_negative, 0.0,
                             "spring stiffness"},
    [BILATERAL_DASHPOT] = {"dashpot", ROW_NUMBER, ROW_PER_VELOCITY_POWER, OF_FORCE,
                           &range_non_negative, 0.0, "damper constant: force at unit velocity"},
    [BILATERAL_EXPONENT] = {"exponent", ROW_NUMBER, ROW_POWER, OF_NONE, &exponent_range, 1.0,
                            "exponent of the velocity in the damper"},
};

static int bilateral_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    for (int i = 0; i < BILATERAL_ROWS; i++) {
        constant[i] = value[i];
    }
    return STATUS_OK;
}

static struct contact_response bilateral_force(const double *c, const double *h, double d,
                                               double v) {
    (void)h;
    struct contact_response r = {.force = c[BILATERAL_STIFFNESS] * d,
                                 .dfdd = c[BILATERAL_STIFFNESS]};
    double dashpot = c[BILATERAL_DASHPOT];
    if (dashpot > 0.0) {
        double a = c[BILATERAL_EXPONENT];
        double slope = a == 1.0 ? dashpot : dashpot * pow(fabs(v), a - 1.0);
        r.force += v == 0.0 ? 0.0 : slope * v;
        r.dfdv = a * slope;
    }
    return r;
}

const struct contact_law bilateral_law = {
    .name = "bilateral",
    .summary = "spring and viscous damper that act in both directions",
    .formula = "F = k d + c |v|^a sign(v)",
    .source = "Soong & Dargush (1997), Passive Energy Dissipation Systems, section 3.5",
    .remarks = "An exponent a below 1 limits the damper force at high velocity.",
    .row = bilateral_rows,
    .n_row = BILATERAL_ROWS,
    .n_constant = BILATERAL_ROWS,
    .traits = CONTACT_MAY_PULL,
    .prepare = bilateral_prepare,
    .force = bilateral_force,
};
