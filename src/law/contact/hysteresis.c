// SPDX-License-Identifier: GPL-3.0-or-later
// The family F = k d^n (1 + q v / v0): a spring with a dashpot that grows with the penetration. Its
// six laws differ in n and in the relation between q = zeta v0 / k and e:
//
//     ye-kelvin           n = 1          q = 3 (1 - e) / (2 e)
//     power               any n          1 + e = (1/q) ln((1 + q) / (1 - e q)), or elastic
//     hertz-damp          n = 3/2 or any q = 3 (1 - e^2) / 4
//     lankarani-nikravesh n = 3/2 or any q = 3 (1 - e^2) / 4
//     ye-hertz-damp       n = 3/2 or any q = 8 (1 - e) / (5 e)
//     hunt-crossley       n = 1 or 3/2   1 + e = (1/q) ln((1 + q) / (1 - e q))
//
// The relation of power and hunt-crossley is exact for every n. The others deliver:
//
//     requested e                 0.65     0.4
//     hertz-damp                  0.7748           exact only near e = 1
//     ye-hertz-damp               0.6303   0.3629  damping too strong for small e
//     ye-kelvin                   0.6457   0.3796
//
// Misprints of one review: e in the denominator of zeta for hertz-damp, v^n in place of d^n, and
// zeta v as the damping force of ye-kelvin.
//
// The force starts and ends at zero. It is negative if the bodies separate faster than v0 / q,
// which needs other forces that pull them. A velocity at closure below `vmin` counts as vmin:
// otherwise the dashpot of a gentle touch would have no limit and hold the bodies together.
#include <math.h>

#include "law/lists.h"
#include "law/power.h"
#include "law/restitution.h"

// Rows of the laws with any exponent, in this order.
enum { K, E, ZETA, VMIN, N, N_ROW };
enum { STIFFNESS, EXPONENT, Q, LEAST_V0, N_CONSTANT };
enum { DAMPING, N_HISTORY };  // q / v0 [T/L]

static const struct row rows[N_ROW] = {
    [K] = POWER_STIFFNESS_ROW("impact stiffness"),
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
              HYSTERESIS_ZETA_DOC},
    [VMIN] = LEAST_V0_ROW,
    [N] = {"n", ROW_NUMBER, ROW_POWER, OF_NONE, &power_range, 1.5, "exponent"},
};

// Rows of ye-kelvin: all except n, the last one.
static const struct row linear_rows[N] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN, "impact stiffness"},
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
              HYSTERESIS_ZETA_DOC},
    [VMIN] = LEAST_V0_ROW,
};

static const struct row power_rows[N_ROW] = {
    [K] = POWER_STIFFNESS_ROW("impact stiffness"),
    [E] = {"e", ROW_NUMBER, 0, OF_NONE, &restitution_range, NAN,
           "coefficient of restitution; default: no damping"},
    [ZETA] = {"zeta", ROW_NUMBER, 0, OF_NONE, &range_non_negative, NAN,
              HYSTERESIS_ZETA_DOC ", instead of -e"},
    [VMIN] = LEAST_V0_ROW,
    [N] = {"n", ROW_NUMBER, ROW_REQUIRED | ROW_POWER, OF_NONE, &power_range, NAN, "exponent"},
};

// `relation` gives q from e; NAN: no memory.
static int family_prepare(const double *value, double n, double (*relation)(double e),
                          double *constant, struct error *e) {
    constant[STIFFNESS] = value[K];
    constant[EXPONENT] = n;
    constant[Q] = restitution_ratio(value[E], value[ZETA], relation);
    constant[LEAST_V0] = value[VMIN];
    return isnan(constant[Q]) ? error_no_memory(e) : STATUS_OK;
}

static void family_close(const double *constant, double v0, double *history) {
    history[DAMPING] = constant[Q] / fmax(v0, constant[LEAST_V0]);
}

static struct contact_response family_force(const double *constant, const double *history, double d,
                                            double v) {
    struct contact_response spring = power_spring(constant[STIFFNESS], constant[EXPONENT], d);
    double factor = 1.0 + history[DAMPING] * v;
    return (struct contact_response){
        .force = spring.force * factor,
        .dfdd = spring.dfdd * factor,
        .dfdv = spring.force * history[DAMPING],
    };
}

// Members that all descriptors share.
#define FAMILY                                                                                     \
    .n_constant = N_CONSTANT, .n_history = N_HISTORY,                                              \
    .traits = CONTACT_MAY_PULL | CONTACT_NEEDS_V0 | CONTACT_SMOOTH, .close = family_close,         \
    .force = family_force, .exact = restitution_exact_q

static double ye_kelvin_q(double e) {
    return 3.0 * (1.0 - e) / (2.0 * e);
}

static int ye_kelvin_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    return family_prepare(value, 1.0, ye_kelvin_q, constant, e);
}

const struct contact_law contact_ye_kelvin = {
    .name = "ye-kelvin",
    .summary = "linear spring with hysteresis damping",
    .formula = "F = k d + zeta d v, zeta = 3 k (1 - e) / (2 e v0)",
    .source = "Ye, Li & Zhu (2009), Earthquake Eng. Eng. Vib. 8, 433-446",
    .remarks = "Use it for flat faces. It delivers a little less than e: 0.646 for 0.65. The force "
               "pulls only if the bodies part faster than v0/q.",
    .example = "-k 93.5MN/m -e 0.65",
    .row = linear_rows,
    .n_row = N,
    .prepare = ye_kelvin_prepare,
    FAMILY,
};

static int power_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    double all[N_ROW] = {value[K], value[E], value[ZETA], value[VMIN], value[N]};
    if (!isnan(all[E]) && !isnan(all[ZETA])) {
        return error_set(e, STATUS_INPUT, "-e and -zeta cannot be combined");
    }
    if (isnan(all[E]) && isnan(all[ZETA])) {
        all[E] = 1.0;
    }
    return family_prepare(all, all[N], restitution_exact_q, constant, e);
}

const struct contact_law contact_power = {
    .name = "power",
    .summary = "spring of any exponent, with or without hysteresis damping",
    .formula = "F = k d^n (1 + q v / v0), 1 + e = (1/q) ln((1 + q) / (1 - e q))",
    .source = "Hunt & Crossley (1975), J. Appl. Mech. 42, 440-445; the relation with e is derived "
              "in docs/theory.md",
    .remarks = "Use it for faces between flat and curved. It delivers e exactly. The force pulls "
               "only if the bodies part faster than v0/q.",
    .example = "-k 30e9N/m^2 -n 2 -e 0.65",
    .row = power_rows,
    .n_row = N_ROW,
    .prepare = power_prepare,
    FAMILY,
};

static int hertz_damp_prepare(const double *value, double m_eff, double *constant,
                              struct error *e) {
    (void)m_eff;
    return family_prepare(value, value[N], restitution_lankarani_nikravesh, constant, e);
}

const struct contact_law contact_hertz_damp = {
    .name = "hertz-damp",
    .summary = "Hertz with hysteresis damping",
    .formula = "F = k d^n + zeta d^n v, zeta = 3 k (1 - e^2) / (4 v0)",
    .source =
        "Muthukumar & DesRoches (2006), Earthquake Eng. Struct. Dyn. 35, 811-828, after Lankarani "
        "& Nikravesh (1990), J. Mech. Des. 112, 369-376",
    .remarks = "Use it for curved faces and e near 1. For a small e it delivers much more: 0.775 "
               "for 0.65. The force pulls only if the bodies part faster than v0/q.",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .prepare = hertz_damp_prepare,
    FAMILY,
};

const struct contact_law contact_lankarani_nikravesh = {
    .name = "lankarani-nikravesh",
    .summary = "Hertz with hysteresis damping, as in multibody dynamics",
    .formula = "F = k d^n (1 + (3 (1 - e^2) / 4) v / v0)",
    .source = "Lankarani & Nikravesh (1990), J. Mech. Des. 112, 369-376",
    .remarks = "The force is that of hertz-damp, under its name in multibody dynamics.",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .prepare = hertz_damp_prepare,
    FAMILY,
};

static double ye_hertz_damp_q(double e) {
    return 8.0 * (1.0 - e) / (5.0 * e);
}

static int ye_hertz_damp_prepare(const double *value, double m_eff, double *constant,
                                 struct error *e) {
    (void)m_eff;
    return family_prepare(value, value[N], ye_hertz_damp_q, constant, e);
}

const struct contact_law contact_ye_hertz_damp = {
    .name = "ye-hertz-damp",
    .summary = "Hertz with hysteresis damping, corrected for small e",
    .formula = "F = k d^n + zeta d^n v, zeta = 8 k (1 - e) / (5 e v0)",
    .source = "Ye, Li & Zhu (2009), Earthquake Eng. Struct. Dyn. 38, 1135-1142",
    .remarks = "Use it for curved faces. It delivers a little less than e: 0.630 for 0.65. The "
               "force pulls only if the bodies part faster than v0/q.",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .prepare = ye_hertz_damp_prepare,
    FAMILY,
};

static int hunt_crossley_prepare(const double *value, double m_eff, double *constant,
                                 struct error *e) {
    (void)m_eff;
    if (value[N] != 1.0 && value[N] != 1.5) {
        return error_set(e, STATUS_INPUT,
                         "n is %.6g; it must be 1 or 1.5 (the law power takes any)", value[N]);
    }
    return family_prepare(value, value[N], restitution_exact_q, constant, e);
}

const struct contact_law contact_hunt_crossley = {
    .name = "hunt-crossley",
    .summary = "spring with hysteresis damping, exact restitution",
    .formula = "F = k d^n + zeta d^n v, n = 1 or 3/2, 1 + e = (1/q) ln((1 + q) / (1 - e q)), "
               "q = zeta v0 / k",
    .source = "Hunt & Crossley (1975), J. Appl. Mech. 42, 440-445; the relation with e is derived "
              "in docs/theory.md",
    .remarks = "Use it for flat faces (n = 1) and curved faces (n = 3/2). It delivers e exactly. "
               "The force pulls only if the bodies part faster than v0/q.",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .prepare = hunt_crossley_prepare,
    FAMILY,
};
