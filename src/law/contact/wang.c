// SPDX-License-Identifier: GPL-3.0-or-later
// Wang's law: F = k d^n + zeta d^n v while v >= 0. After this the spring relaxes along
//     F = f_e ((d - d_e) / (d_max - d_e))^n,   f_e = k d_max^n,   d_e = R d_max.
// Below the residual penetration d_e there is no force.
//
// Only d_max, the largest penetration of the contact, is stored, because f_e / (d_max - d_e)^n = k
// / (1 - R)^n. With -e, zeta is q k / v0. The approach stores the share 2 (q - ln(1 + q)) / q^2 of
// the energy in the spring (restitution_stored_q), and the release returns 1 - R of this:
//
//     e^2 = 2 (1 - R) (q - ln(1 + q)) / q^2,   so e^2 <= 1 - R.
//
// The slope of the force jumps at v = 0. The force jumps only in a renewed approach within one
// contact, which follows the first branch again.
#include <math.h>

#include "law/lists.h"
#include "law/power.h"
#include "law/restitution.h"

enum { K, E, ZETA, RESIDUAL, VMIN, N, N_ROW };
// DAMPING: zeta, if given; PER_VELOCITY: q k; RELEASE: k / (1 - R)^n
enum { STIFFNESS, DAMPING, PER_VELOCITY, LEAST_V0, SHARE, RELEASE, EXPONENT, N_CONSTANT };
enum { DEEPEST, DASHPOT, N_HISTORY };

static const struct range residual_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

static const struct row rows[N_ROW] = {
    [K] = POWER_STIFFNESS_ROW("impact stiffness"),
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF | ROW_PER_LENGTH_POWER, OF_DASHPOT,
              &range_non_negative, NAN, "damping during approach"},
    [RESIDUAL] = {"residual", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &residual_range, NAN,
                  "R: residual penetration over the largest one"},
    [VMIN] = LEAST_V0_ROW,
    [N] = {"n", ROW_NUMBER, ROW_POWER, OF_NONE, &power_range, 1.5, "exponent"},
};

static int wang_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)m_eff;
    double stored = value[E] * value[E] / (1.0 - value[RESIDUAL]);
    if (stored > 1.0) {
        return error_set(e, STATUS_INPUT,
                         "e is %.6g; with a residual of %.6g it must be <= %.6g, sqrt(1 - R)",
                         value[E], value[RESIDUAL], sqrt(1.0 - value[RESIDUAL]));
    }
    double q = isnan(value[E]) ? 0.0 : restitution_stored_q(stored);
    if (isnan(q)) {
        return error_no_memory(e);
    }
    constant[STIFFNESS] = value[K];
    constant[DAMPING] = isnan(value[E]) ? value[ZETA] : 0.0;
    constant[PER_VELOCITY] = q * value[K];
    constant[LEAST_V0] = value[VMIN];
    constant[SHARE] = value[RESIDUAL];
    constant[RELEASE] = value[K] / pow(1.0 - value[RESIDUAL], value[N]);
    constant[EXPONENT] = value[N];
    return STATUS_OK;
}

static void wang_close(const double *c, double v0, double *history) {
    history[DEEPEST] = 0.0;
    history[DASHPOT] = c[DAMPING] + c[PER_VELOCITY] / fmax(v0, c[LEAST_V0]);
}

static struct contact_response wang_force(const double *c, const double *h, double d, double v) {
    if (v < 0.0 && d < h[DEEPEST]) {
        return power_spring(c[RELEASE], c[EXPONENT], fmax(d - c[SHARE] * h[DEEPEST], 0.0));
    }
    struct contact_response r = power_spring(c[STIFFNESS], c[EXPONENT], d);
    if (v >= 0.0) {
        struct contact_response damper = power_spring(h[DASHPOT], c[EXPONENT], d);
        r.force += damper.force * v;
        r.dfdd += damper.dfdd * v;
        r.dfdv = damper.force;
    }
    return r;
}

// The release ends at d_e, before d = 0.
static double wang_kink(const double *c, const double *h, const struct contact_way *way) {
    double residual = c[SHARE] * h[DEEPEST];
    bool comes = residual > 0.0 && way->d < way->d0 && way->d0 > residual;
    return comes ? way->d - residual : INFINITY;
}

static void wang_commit(const double *c, double *history, double d, double v) {
    (void)c, (void)v;
    history[DEEPEST] = fmax(history[DEEPEST], d);
}

const struct contact_law contact_wang = {
    .name = "wang",
    .summary = "Hertz with damped approach and residual penetration",
    .formula = "F = k d^n + zeta d^n v while v >= 0; then f_e ((d - d_e) / (d_max - d_e))^n, "
               "f_e = k d_max^n, d_e = R d_max; 0 below d_e; zeta = q k / v0, "
               "e^2 = 2 (1 - R) (q - ln(1 + q)) / q^2",
    .source = "Wang, Hua, Wang, Chen & Song (2017), J. Eng. Mech. 143, Advanced impact force model "
              "for low-speed pounding between viscoelastic materials and steel; the relation with "
              "e is derived in docs/theory.md",
    .remarks = "Use it for viscoelastic layers against steel, and for contacts that keep a dent. "
               "With -e it delivers e exactly; with -zeta the restitution depends on the velocity. "
               "e^2 must be <= 1 - R. If the bodies approach again within one contact, the force "
               "jumps back to the first branch.",
    .example = "-k 2.75e9N/m^1.5 -zeta 5.5e9N*s/m^2.5 -residual 0.25",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = CONTACT_NEEDS_V0 | CONTACT_EXACT,
    .prepare = wang_prepare,
    .close = wang_close,
    .force = wang_force,
    .kink = wang_kink,
    .commit = wang_commit,
};
