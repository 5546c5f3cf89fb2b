// SPDX-License-Identifier: GPL-3.0-or-later
// Wang's law: F = k d^n + zeta d^n v while v >= 0; after that the spring is relaxed along
//     F = f_e ((d - d_e) / (d_max - d_e))^n,   f_e = k d_max^n,   d_e = R d_max,
// and there is no force below the residual penetration d_e.
//
// As f_e / (d_max - d_e)^n = k / (1 - R)^n, only d_max is kept, the largest penetration of the
// contact. The slope of the force jumps at v = 0; the force itself does only where an approach is
// renewed within one contact, which follows the first branch again.
#include <math.h>

#include "law/contact_list.h"
#include "law/power.h"

enum { K, ZETA, RESIDUAL, N, N_ROW };
enum { STIFFNESS, DAMPING, SHARE, RELEASE, EXPONENT, N_CONSTANT };  // RELEASE: k / (1 - R)^n
enum { DEEPEST, N_HISTORY };

static const struct range residual_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

static const struct row rows[N_ROW] = {
    [K] = {"k",
           ROW_NUMBER,
           ROW_REQUIRED | ROW_PER_LENGTH_POWER,
           {1, 0, 0},
           &range_positive,
           NAN,
           "impact stiffness"},
    [ZETA] = {"zeta",
              ROW_NUMBER,
              ROW_REQUIRED | ROW_PER_LENGTH_POWER,
              {1, -1, 1},
              &range_non_negative,
              NAN,
              "damping during approach"},
    [RESIDUAL] = {"residual",
                  ROW_NUMBER,
                  ROW_REQUIRED,
                  {0},
                  &residual_range,
                  NAN,
                  "residual over largest penetration"},
    [N] = {"n", ROW_NUMBER, ROW_POWER, {0}, &power_range, 1.5, "exponent"},
};

static int wang_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff, (void)e;
    constant[STIFFNESS] = value[K];
    constant[DAMPING] = value[ZETA];
    constant[SHARE] = value[RESIDUAL];
    constant[RELEASE] = value[K] / pow(1.0 - value[RESIDUAL], value[N]);
    constant[EXPONENT] = value[N];
    return STATUS_OK;
}

static void wang_close(const double *c, double v0, double *history) {
    (void)c, (void)v0;
    history[DEEPEST] = 0.0;
}

static struct contact_response wang_force(const double *c, const double *h, double d, double v) {
    if (v < 0.0 && d < h[DEEPEST]) {
        return power_spring(c[RELEASE], c[EXPONENT], fmax(d - c[SHARE] * h[DEEPEST], 0.0));
    }
    struct contact_response r = power_spring(c[STIFFNESS], c[EXPONENT], d);
    if (v >= 0.0) {
        struct contact_response damper = power_spring(c[DAMPING], c[EXPONENT], d);
        r.force += damper.force * v;
        r.dfdd += damper.dfdd * v;
        r.dfdv = damper.force;
    }
    return r;
}

static void wang_commit(const double *c, double *history, double d, double v) {
    (void)c, (void)v;
    history[DEEPEST] = fmax(history[DEEPEST], d);
}

const struct contact_law contact_wang = {
    .name = "wang",
    .summary = "Hertz with damped approach and residual penetration",
    .formula = "F = k d^n + zeta d^n v while v >= 0; then f_e ((d - d_e) / (d_max - d_e))^n, "
               "f_e = k d_max^n, d_e = R d_max; 0 below d_e",
    .source = "Wang, Hua, Wang, Chen & Song (2017), J. Eng. Mech. 143(12), 04017139",
    .remarks = "never pulls; e follows from zeta, R and the velocity: with zeta = 0, e^2 = 1 - R",
    .example = "-k 2.75e9N/m^1.5 -zeta 5.5e9N*s/m^2.5 -residual 0.25",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .prepare = wang_prepare,
    .close = wang_close,
    .force = wang_force,
    .commit = wang_commit,
};
