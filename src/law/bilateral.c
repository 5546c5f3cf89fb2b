// SPDX-License-Identifier: GPL-3.0-or-later
// Spring and damper that push and pull: F = k d + c |v|^a sign(v). d and v may have either sign.
// For a < 1 the force has an infinite slope at v = 0. Beyond the relief force F_r of the damper,
// which it reaches at v_r, its force is F_r + c_r (|v| - v_r).
#include "law/bilateral.h"

#include <math.h>

const struct range bilateral_exponent = {
    .min = 0.0, .max = 3.0, .min_open = true, .text = "> 0 and <= 3"};

const struct row bilateral_rows[BILATERAL_ROWS] = {
    [BILATERAL_STIFFNESS] = {"stiffness", ROW_NUMBER, 0, OF_STIFFNESS, &range_non_negative, 0.0,
                             "spring stiffness"},
    [BILATERAL_DASHPOT] = {"dashpot", ROW_NUMBER, ROW_PER_VELOCITY_POWER, OF_FORCE,
                           &range_non_negative, 0.0, "damper constant: force at unit velocity"},
    [BILATERAL_EXPONENT] = {"exponent", ROW_NUMBER, ROW_POWER, OF_NONE, &bilateral_exponent, 1.0,
                            "exponent of the velocity in the damper"},
    [BILATERAL_RELIEF] = {"relief", ROW_NUMBER, 0, OF_FORCE, &range_positive, NAN,
                          "force at which a valve opens; default: none opens"},
    [BILATERAL_RELIEF_DASHPOT] = {"relief-dashpot", ROW_NUMBER, 0, OF_DASHPOT, &range_non_negative,
                                  0.0, "damper constant beyond the relief force"},
};

// The other constants are those of the rows.
enum { RELIEF_VELOCITY = BILATERAL_ROWS, N_CONSTANT };

static int bilateral_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    for (int i = 0; i < BILATERAL_ROWS; i++) {
        constant[i] = value[i];
    }
    const double relief = value[BILATERAL_RELIEF], dashpot = value[BILATERAL_DASHPOT];
    constant[BILATERAL_RELIEF] = isnan(relief) ? INFINITY : relief;
    constant[RELIEF_VELOCITY] = isnan(relief) || dashpot == 0.0
                                    ? INFINITY
                                    : pow(relief / dashpot, 1.0 / value[BILATERAL_EXPONENT]);
    return STATUS_OK;
}

static struct contact_response bilateral_force(const double *c, const double *h, double d,
                                               double v) {
    (void)h;
    struct contact_response r = {.force = c[BILATERAL_STIFFNESS] * d,
                                 .dfdd = c[BILATERAL_STIFFNESS]};
    double dashpot = c[BILATERAL_DASHPOT];
    if (fabs(v) > c[RELIEF_VELOCITY]) {
        const double beyond = c[BILATERAL_RELIEF_DASHPOT] * (fabs(v) - c[RELIEF_VELOCITY]);
        r.force += copysign(c[BILATERAL_RELIEF] + beyond, v);
        r.dfdv = c[BILATERAL_RELIEF_DASHPOT];
    } else if (dashpot > 0.0) {
        double a = c[BILATERAL_EXPONENT];
        double slope = a == 1.0 ? dashpot : dashpot * pow(fabs(v), a - 1.0);
        r.force += v == 0.0 ? 0.0 : slope * v;
        r.dfdv = a * slope;
    }
    return r;
}

static double bilateral_kink(const double *c, const double *h, const struct contact_way *way) {
    (void)h;
    const double beyond = fabs(way->v) - c[RELIEF_VELOCITY];
    return fabs(way->v0) > c[RELIEF_VELOCITY] ? beyond : -beyond;
}

static double bilateral_stored(const double *c, const double *h, double d) {
    (void)h;
    return c[BILATERAL_STIFFNESS] * d * d / 2.0;
}

bool bilateral_is_linear(const struct contact_law *law, const double *constant) {
    return law == &bilateral_law && isinf(constant[BILATERAL_RELIEF]) &&
           (constant[BILATERAL_DASHPOT] == 0.0 || constant[BILATERAL_EXPONENT] == 1.0);
}

bool bilateral_is_steep(const struct contact_law *law, const double *constant) {
    return law == &bilateral_law && constant[BILATERAL_DASHPOT] > 0.0 &&
           constant[BILATERAL_EXPONENT] < 1.0;
}

const struct contact_law bilateral_law = {
    .name = "viscous",
    .summary = "spring and viscous damper that act in both directions",
    .formula = "F = k d + c |v|^a sign(v)",
    .source = "Soong & Dargush (1997), Passive Energy Dissipation Systems, section 3.5",
    .remarks =
        "An exponent a below 1 limits the damper force at high velocity. Beyond -relief F_r, "
        "which the damper reaches at v_r, its force is F_r + c_r (|v| - v_r), with "
        "-relief-dashpot c_r.",
    .row = bilateral_rows,
    .n_row = BILATERAL_ROWS,
    .n_constant = N_CONSTANT,
    .traits = CONTACT_MAY_PULL,
    .prepare = bilateral_prepare,
    .force = bilateral_force,
    .kink = bilateral_kink,
    .stored = bilateral_stored,
};
