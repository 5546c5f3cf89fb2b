// SPDX-License-Identifier: GPL-3.0-or-later
// Bouc & Wen's storey: a smooth elastoplastic spring beside an elastic one,
//
//     V = R k drift + (1 - R) V_y z,   d_y dz/d drift = 1 - |z|^n (gamma + beta sgn(z d drift)),
//
// with d_y = V_y / k. The law does not depend on the rate: the change of z follows from the change
// of the drift. Let z be positive in the direction of the drift, and s the drift over d_y. Then
//
//     dz/ds = 1 + m |z|^n for z < 0, m = beta - gamma;
//     dz/ds = 1 - P z^n   for z > 0, P = beta + gamma.
//
// For n = 1 and n = 2 both equations have a closed form. For other n the classical Runge-Kutta
// method integrates from the committed point in steps of 0.02 d_y. A step ends at z = 0, where the
// slope has a kink. The error is below 1e-8 V_y for n = 3 and below 2e-6 V_y for all n up to 20.
//
// wen.h has degradation and pinching.
//
// The tangent is dz/d drift at the end. With beta >= |gamma| neither m nor P is negative, and loops
// create no energy (Erlicher & Point 2004). If beta + gamma = 1, the strength of the yielding part
// is (1 - R) V_y.
#include <math.h>
#include <stdbool.h>

#include "law/lists.h"
#include "law/wen.h"
#include "law/yield.h"

enum {
    YIELD,
    HARDENING,
    N,
    BETA,
    GAMMA,
    DELTA_A,
    DELTA_NU,
    DELTA_ETA,
    ZETA_S,
    Q,
    P,
    PSI,
    DELTA_PSI,
    LAMBDA,
    N_ROW
};

static const double SHORT = 2e-3;   // square of a step, in units of d_y^2: below, a series
static const double ENOUGH = 60.0;  // drift in units of d_y after which z is constant

static const struct range exponent_range = {.min = 1.0, .max = 20.0, .text = ">= 1 and <= 20"};

static const struct range zeta_range = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

#define WEAR_ROW(key, range, fallback, doc)                                                        \
    { key, ROW_NUMBER, 0, OF_NONE, range, fallback, doc }

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = HARDENING_ROW,
    [N] = {"n", ROW_NUMBER, 0, OF_NONE, &exponent_range, 2.0, "sharpness of the yielding"},
    [BETA] = {"beta", ROW_NUMBER, 0, OF_NONE, &range_positive, 0.5, "shape of the loops"},
    [GAMMA] = {"gamma", ROW_NUMBER, 0, OF_NONE, NULL, 0.5,
               "shape of the loops; its size is at most beta"},
    [DELTA_A] = WEAR_ROW("delta-A", &range_non_negative, 0.0, "loss of A per unit of e"),
    [DELTA_NU] = WEAR_ROW("delta-nu", &range_non_negative, 0.0,
                          "loss of strength: growth of nu per unit of e"),
    [DELTA_ETA] = WEAR_ROW("delta-eta", &range_non_negative, 0.0,
                           "loss of stiffness: growth of eta per unit of e"),
    [ZETA_S] = WEAR_ROW("zeta-s", &zeta_range, 0.0, "share of slip in the end; 0: no pinching"),
    [Q] = WEAR_ROW("q", &zeta_range, 0.0, "shear at which it slips, over the strength"),
    [P] = WEAR_ROW("p", &range_non_negative, 1.0, "how fast pinching begins, per unit of e"),
    [PSI] = WEAR_ROW("psi", &range_positive, 0.2, "width of the slip at first"),
    [DELTA_PSI] = WEAR_ROW("delta-psi", &range_non_negative, 0.0, "its growth per unit of e"),
    [LAMBDA] = WEAR_ROW("lambda", &range_positive, 0.5, "width of the slip at zeta1 = 0, over psi"),
};

static int bouc_wen_prepare(const double *value, double stiffness, double *constant,
                            struct error *e) {
    if (fabs(value[GAMMA]) > value[BETA]) {
        return error_set(e, STATUS_INPUT,
                         "gamma is %.6g; its size must be <= beta, which is %.6g, or the storey "
                         "would create energy",
                         value[GAMMA], value[BETA]);
    }
    double r = value[HARDENING];
    constant[WEN_BACK] = r * stiffness;
    constant[WEN_STRENGTH] = (1.0 - r) * value[YIELD];
    constant[WEN_PER_DRIFT] = stiffness / value[YIELD];
    constant[WEN_SLOPE] = constant[WEN_STRENGTH] * constant[WEN_PER_DRIFT];
    constant[WEN_EXPONENT] = value[N];
    constant[WEN_PLUS] = value[GAMMA] + value[BETA];
    constant[WEN_MINUS] = value[GAMMA] - value[BETA];
    constant[WEN_ROOT_OF_PLUS] = sqrt(constant[WEN_PLUS]);
    constant[WEN_ROOT_OF_MINUS] = sqrt(-constant[WEN_MINUS]);
    constant[WEN_YIELDING] = 1.0 - r;
    constant[WEN_DEGRADES] = value[DELTA_A] > 0.0 || value[DELTA_NU] > 0.0 ||
                             value[DELTA_ETA] > 0.0 || value[ZETA_S] > 0.0;
    for (int i = DELTA_A; i < N_ROW; i++) {
        constant[WEN_WEAR + i - DELTA_A] = value[i];
    }
    return STATUS_OK;
}

// n = 1, on one side of z = 0: dz/ds = 1 - p z, where p is P or m.
static double relax(double p, double z, double s) {
    return p != 0.0 ? z - (1.0 - p * z) * expm1(-p * s) / p : z + s;
}

static double advance_linear(const double *c, double z, double s) {
    if (z < 0.0) {
        const double m = -c[WEN_MINUS];
        const double beyond = s - (m > 0.0 ? log1p(-m * z) / m : -z);  // z = 0
        if (beyond < 0.0) {
            return relax(m, z, s);
        }
        s = beyond;
        z = 0.0;
    }
    return relax(c[WEN_PLUS], z, s);
}

// tanh(root s) / root for p = root^2, tan(root s) / root for p = -root^2, and s for p = 0. Most
// steps are short: then the series is right to the last bits and takes a fraction of the time.
static inline double tanh_over_root(double p, double root, double s) {
    const double y = p * s * s;
    if (fabs(y) > SHORT) {
        return (p > 0.0 ? tanh(root * s) : tan(root * s)) / root;
    }
    const double low = -1.0 / 3.0 + y * (2.0 / 15.0), high = -17.0 / 315.0 + y * (62.0 / 2835.0);
    return s + s * y * (low + y * y * high);
}

// n = 2, on one side of z = 0: dz/ds = 1 - p z^2, where p is P or -m.
static inline double saturate(double p, double root, double z, double s) {
    const double t = tanh_over_root(p, root, s);
    return (z + t) / (1.0 + p * z * t);
}

static inline double advance_squared(const double *c, double z, double s) {
    if (z < 0.0) {
        const double p = c[WEN_MINUS], root = c[WEN_ROOT_OF_MINUS];
        const double beyond = s - (p < 0.0 ? atan(-z * root) / root : -z);  // z = 0
        if (beyond < 0.0) {
            return p < 0.0 ? saturate(p, root, z, s) : beyond;
        }
        s = beyond;
        z = 0.0;
    }
    return saturate(c[WEN_PLUS], c[WEN_ROOT_OF_PLUS], z, s);
}

static double runge_kutta(const double *c, double z, double h) {
    double k1 = wen_slope(c, z);
    double k2 = wen_slope(c, z + h / 2.0 * k1);
    double k3 = wen_slope(c, z + h / 2.0 * k2);
    double k4 = wen_slope(c, z + h * k3);
    return z + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// The drift from z < 0 to z = 0, as the integral of dz / slope by Simpson's rule.
static double way_to_zero(const double *c, double z) {
    return -z / 6.0 * (1.0 / wen_slope(c, z) + 4.0 / wen_slope(c, z / 2.0) + 1.0);
}

// z after the drift s through z = 0, where the slope has a kink.
static double through_zero(const double *c, double z, double h) {
    double end = runge_kutta(c, z, h);
    return z < 0.0 && end > 0.0 ? runge_kutta(c, 0.0, h - way_to_zero(c, z)) : end;
}

// z after the drift s >= 0 from z.
static double advance(const double *c, double z, double s) {
    if (c[WEN_EXPONENT] == 1.0) {
        return advance_linear(c, z, s);
    }
    double left = fmin(s, ENOUGH);
    for (; left > WEN_STEP; left -= WEN_STEP) {
        z = through_zero(c, z, WEN_STEP);
    }
    return through_zero(c, z, left);
}

// z at a drift in the direction of the way there, which *sign tells.
static inline double z_at(const double *c, const double *h, double drift, double *sign) {
    const double s = (drift - h[WEN_DRIFT]) * c[WEN_PER_DRIFT];
    *sign = copysign(1.0, s);
    const double z = *sign * h[WEN_Z];
    return c[WEN_EXPONENT] == 2.0 ? advance_squared(c, z, fabs(s)) : advance(c, z, fabs(s));
}

static struct storey_response bouc_wen_respond(const double *c, const double *h, double drift,
                                               double *after) {
    if (c[WEN_DEGRADES] != 0.0) {
        return wen_worn_respond(c, h, drift, after);
    }
    double sign;
    const double z = z_at(c, h, drift, &sign);
    if (after) {
        after[WEN_Z] = sign * z;
        after[WEN_DRIFT] = drift;
    }
    return (struct storey_response){
        .shear = c[WEN_BACK] * drift + c[WEN_STRENGTH] * (sign * z),
        .tangent = c[WEN_BACK] + c[WEN_SLOPE] * wen_slope(c, z),
    };
}

// Energy of the elastic spring, plus the energy of the other one in unloading at its initial
// stiffness.
static double bouc_wen_stored(const double *c, const double *h, double drift) {
    if (c[WEN_DEGRADES] != 0.0) {
        return wen_worn_stored(c, h, drift);
    }
    double sign;
    double z = z_at(c, h, drift, &sign);
    return (c[WEN_BACK] * drift * drift + c[WEN_STRENGTH] / c[WEN_PER_DRIFT] * z * z) / 2.0;
}

static void bouc_wen_describe(const double *c, struct storey_figures *out) {
    const double drift = 1.0 / c[WEN_PER_DRIFT];
    yield_describe(drift, c[WEN_BACK] * drift + c[WEN_STRENGTH], out);
}

const struct storey_law storey_bouc_wen = {
    .name = "bouc-wen",
    .summary = "smooth yielding; degradation and pinching",
    .formula = "V = R k drift + (1 - R) V_y z, d_y dz/d drift = 1 - |z|^n (gamma + beta sgn(z d "
               "drift)), d_y = V_y / k",
    .source =
        "Bouc (1967), Proc. 4th Conf. Nonlinear Oscillation, Prague; Wen (1976), J. Eng. Mech. "
        "Div. ASCE 102, 249-263; degradation: Baber & Wen (1981), J. Eng. Mech. Div. ASCE 107, "
        "1069-1087; pinching: Baber & Noori (1985), J. Eng. Mech. ASCE 111, 1010-1026, in the form "
        "of "
        "Foliente (1995), J. Struct. Eng. 121, 1013-1022",
    .remarks =
        "e is the work of the yielding part over V_y d_y. dz is multiplied by h / eta, A takes the "
        "place of 1 and nu multiplies gamma and beta; h = 1 - zeta1 exp(-((z sgn(d drift) - q z_u) "
        "/ "
        "zeta2)^2), zeta1 = zeta-s (1 - exp(-p e)), zeta2 = (psi + delta-psi e) (lambda + zeta1). "
        "Typical for timber: n 1 to 3, beta 0.5 to 0.9, zeta-s 0.7 to 0.98, q 0 to 0.3, p 0.1 to "
        "2, "
        "psi 0.1 to 0.5, lambda 0.1 to 0.8. Small loops at V > 0 let the shear relax and drifts "
        "creep. Growing eta and falling A raise the energy stored at the same z: without pinching, "
        "loading gives back dissipated energy where z^(n - 2) < (delta-A / A + delta-eta) / (2 nu "
        "(beta + gamma)), for n = 2 only if delta-A / A + delta-eta is above 2 nu (beta + gamma). "
        "A tangent near 0 (zeta-s near 1) and narrow slips (psi lambda < 0.02) need short "
        "steps",
    .example = "-yield 600kN -hardening 0.05 -n 1 -delta-nu 0.02 -delta-eta 0.02 "
               "-zeta-s 0.9 -q 0.1",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = WEN_CONSTANTS,
    .n_history = WEN_HISTORY,
    .prepare = bouc_wen_prepare,
    .respond = bouc_wen_respond,
    .stored = bouc_wen_stored,
    .describe = bouc_wen_describe,
};
