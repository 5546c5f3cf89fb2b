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
// The tangent is dz/d drift at the end. With beta >= |gamma| neither m nor P is negative, and loops
// create no energy (Erlicher & Point 2004). If beta + gamma = 1, the strength of the yielding part
// is (1 - R) V_y.
#include <math.h>
#include <stdbool.h>

#include "law/lists.h"
#include "law/yield.h"

enum { YIELD, HARDENING, N, BETA, GAMMA, N_ROW };
enum {
    BACK,
    STRENGTH,
    PER_DRIFT,  // 1 / d_y
    SLOPE,      // slope of the yielding part at z = 0
    EXPONENT,
    PLUS,   // gamma + beta
    MINUS,  // gamma - beta
    ROOT_OF_PLUS,
    ROOT_OF_MINUS,  // root of -MINUS
    N_CONSTANT
};
enum { DRIFT, Z, N_HISTORY };

static const double STEP = 0.02;    // step of the drift, in units of d_y
static const double SHORT = 2e-3;   // square of a step, in units of d_y^2: below, a series
static const double ENOUGH = 60.0;  // drift in units of d_y after which z is constant

static const struct range exponent_range = {.min = 1.0, .max = 20.0, .text = ">= 1 and <= 20"};

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = HARDENING_ROW,
    [N] = {"n", ROW_NUMBER, 0, OF_NONE, &exponent_range, 2.0, "sharpness of the yielding"},
    [BETA] = {"beta", ROW_NUMBER, 0, OF_NONE, &range_positive, 0.5, "shape of the loops"},
    [GAMMA] = {"gamma", ROW_NUMBER, 0, OF_NONE, NULL, 0.5,
               "shape of the loops; its size is at most beta"},
};

static int bouc_wen_prepare(const double *value, double stiffness, double *constant,
                            struct error *e) {
    if (stiffness == 0.0) {
        return error_set(e, STATUS_INPUT, "a storey of stiffness 0 cannot yield");
    }
    if (fabs(value[GAMMA]) > value[BETA]) {
        return error_set(e, STATUS_INPUT,
                         "gamma is %.6g; its size must be <= beta, which is %.6g, or the storey "
                         "would create energy",
                         value[GAMMA], value[BETA]);
    }
    double r = value[HARDENING];
    constant[BACK] = r * stiffness;
    constant[STRENGTH] = (1.0 - r) * value[YIELD];
    constant[PER_DRIFT] = stiffness / value[YIELD];
    constant[SLOPE] = constant[STRENGTH] * constant[PER_DRIFT];
    constant[EXPONENT] = value[N];
    constant[PLUS] = value[GAMMA] + value[BETA];
    constant[MINUS] = value[GAMMA] - value[BETA];
    constant[ROOT_OF_PLUS] = sqrt(constant[PLUS]);
    constant[ROOT_OF_MINUS] = sqrt(-constant[MINUS]);
    return STATUS_OK;
}

// dz/ds along the drift s in units of d_y; z counts positive in the direction of the drift.
static inline double slope(const double *c, double z) {
    const double n = c[EXPONENT];
    const double power = n == 2.0 ? z * z : n == 1.0 ? fabs(z) : pow(fabs(z), n);
    return 1.0 - power * (z > 0.0 ? c[PLUS] : c[MINUS]);
}

// n = 1, on one side of z = 0: dz/ds = 1 - p z, where p is P or m.
static double relax(double p, double z, double s) {
    return p != 0.0 ? z - (1.0 - p * z) * expm1(-p * s) / p : z + s;
}

static double advance_linear(const double *c, double z, double s) {
    if (z < 0.0) {
        const double m = -c[MINUS];
        const double beyond = s - (m > 0.0 ? log1p(-m * z) / m : -z);  // z = 0
        if (beyond < 0.0) {
            return relax(m, z, s);
        }
        s = beyond;
        z = 0.0;
    }
    return relax(c[PLUS], z, s);
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
        const double p = c[MINUS], root = c[ROOT_OF_MINUS];
        const double beyond = s - (p < 0.0 ? atan(-z * root) / root : -z);  // z = 0
        if (beyond < 0.0) {
            return p < 0.0 ? saturate(p, root, z, s) : beyond;
        }
        s = beyond;
        z = 0.0;
    }
    return saturate(c[PLUS], c[ROOT_OF_PLUS], z, s);
}

static double runge_kutta(const double *c, double z, double h) {
    double k1 = slope(c, z);
    double k2 = slope(c, z + h / 2.0 * k1);
    double k3 = slope(c, z + h / 2.0 * k2);
    double k4 = slope(c, z + h * k3);
    return z + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// The drift from z < 0 to z = 0, as the integral of dz / slope by Simpson's rule.
static double way_to_zero(const double *c, double z) {
    return -z / 6.0 * (1.0 / slope(c, z) + 4.0 / slope(c, z / 2.0) + 1.0);
}

// z after the drift s through z = 0, where the slope has a kink.
static double through_zero(const double *c, double z, double h) {
    double end = runge_kutta(c, z, h);
    return z < 0.0 && end > 0.0 ? runge_kutta(c, 0.0, h - way_to_zero(c, z)) : end;
}

// z after the drift s >= 0 from z.
static double advance(const double *c, double z, double s) {
    if (c[EXPONENT] == 1.0) {
        return advance_linear(c, z, s);
    }
    double left = fmin(s, ENOUGH);
    for (; left > STEP; left -= STEP) {
        z = through_zero(c, z, STEP);
    }
    return through_zero(c, z, left);
}

// z at a drift in the direction of the way there, which *sign tells.
static inline double z_at(const double *c, const double *h, double drift, double *sign) {
    const double s = (drift - h[DRIFT]) * c[PER_DRIFT];
    *sign = copysign(1.0, s);
    const double z = *sign * h[Z];
    return c[EXPONENT] == 2.0 ? advance_squared(c, z, fabs(s)) : advance(c, z, fabs(s));
}

static struct storey_response bouc_wen_respond(const double *c, const double *h, double drift,
                                               double *after) {
    double sign;
    const double z = z_at(c, h, drift, &sign);
    if (after) {
        after[Z] = sign * z;
        after[DRIFT] = drift;
    }
    return (struct storey_response){
        .shear = c[BACK] * drift + c[STRENGTH] * (sign * z),
        .tangent = c[BACK] + c[SLOPE] * slope(c, z),
    };
}

// Energy of the elastic spring, plus the energy of the other one in unloading at its initial
// stiffness.
static double bouc_wen_stored(const double *c, const double *h, double drift) {
    double sign;
    double z = z_at(c, h, drift, &sign);
    return (c[BACK] * drift * drift + c[STRENGTH] / c[PER_DRIFT] * z * z) / 2.0;
}

const struct storey_law storey_bouc_wen = {
    .name = "bouc-wen",
    .summary = "smooth yielding",
    .formula = "V = R k drift + (1 - R) V_y z, d_y dz/d drift = 1 - |z|^n (gamma + beta sgn(z d "
               "drift)), d_y = V_y / k",
    .source =
        "Bouc (1967), Proc. 4th Conf. Nonlinear Oscillation, Prague; Wen (1976), J. Eng. Mech. "
        "Div. ASCE 102, 249-263",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .prepare = bouc_wen_prepare,
    .respond = bouc_wen_respond,
    .stored = bouc_wen_stored,
};
