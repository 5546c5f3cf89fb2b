// SPDX-License-Identifier: GPL-3.0-or-later
// Bouc & Wen's storey: a smooth elastoplastic spring beside an elastic one,
//
//     V = R k drift + (1 - R) V_y z,   d_y dz/d drift = 1 - |z|^n (gamma + beta sgn(z d drift)),
//
// with d_y = V_y / k. Independent of the rate: the increment of z follows from that of the drift.
// It is found by the classical Runge-Kutta method in steps of 0.02 d_y from the committed point
// that end at z = 0, where the slope has a kink (error about 1e-9), until z has reached its end
// value; the tangent is dz/d drift there. beta >= |gamma| keeps the loops from creating energy
// (Erlicher & Point 2004). With the sum of beta and gamma 1, V_y is the strength of the yielding
// part.
#include <math.h>

#include "law/storey_list.h"
#include "law/yield.h"

enum { YIELD, HARDENING, N, BETA, GAMMA, N_ROW };
enum { BACK, STRENGTH, DRIFT_OF_YIELD, EXPONENT, PLUS, MINUS, N_CONSTANT };  // gamma +- beta
enum { DRIFT, Z, N_HISTORY };

static const double STEP = 0.02;    // of the drift, in units of d_y
static const double ENOUGH = 60.0;  // drift in units of d_y after which z does not change any more

static const struct range exponent_range = {.min = 1.0, .max = 20.0, .text = ">= 1 and <= 20"};

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = HARDENING_ROW,
    [N] = {"n", ROW_NUMBER, 0, OF_NONE, &exponent_range, 2.0, "sharpness of the yielding"},
    [BETA] = {"beta", ROW_NUMBER, 0, OF_NONE, &range_positive, 0.5, "shape of the loops"},
    [GAMMA] = {"gamma", ROW_NUMBER, 0, OF_NONE, NULL, 0.5, "shape of the loops, of size <= beta"},
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
    constant[DRIFT_OF_YIELD] = value[YIELD] / stiffness;
    constant[EXPONENT] = value[N];
    constant[PLUS] = value[GAMMA] + value[BETA];
    constant[MINUS] = value[GAMMA] - value[BETA];
    return STATUS_OK;
}

// dz/ds along the drift s in units of d_y; z counts positive in the direction of the drift.
static double slope(const double *c, double z) {
    return 1.0 - pow(fabs(z), c[EXPONENT]) * (z > 0.0 ? c[PLUS] : c[MINUS]);
}

static double runge_kutta(const double *c, double z, double h) {
    double k1 = slope(c, z);
    double k2 = slope(c, z + h / 2.0 * k1);
    double k3 = slope(c, z + h / 2.0 * k2);
    double k4 = slope(c, z + h * k3);
    return z + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

// The drift from z < 0 to 0, by Simpson's rule: the integral of dz / slope.
static double way_to_zero(const double *c, double z) {
    return -z / 6.0 * (1.0 / slope(c, z) + 4.0 / slope(c, z / 2.0) + 1.0);
}

// The same through z = 0, where the slope has a kink.
static double through_zero(const double *c, double z, double h) {
    double end = runge_kutta(c, z, h);
    return z < 0.0 && end > 0.0 ? runge_kutta(c, 0.0, h - way_to_zero(c, z)) : end;
}

// z after the drift s >= 0 from z.
static double advance(const double *c, double z, double s) {
    double left = fmin(s, ENOUGH);
    for (; left > STEP; left -= STEP) {
        z = through_zero(c, z, STEP);
    }
    return through_zero(c, z, left);
}

static double z_at(const double *c, const double *h, double drift, double *sign) {
    double s = (drift - h[DRIFT]) / c[DRIFT_OF_YIELD];
    *sign = s < 0.0 ? -1.0 : 1.0;
    return *sign * advance(c, *sign * h[Z], fabs(s));
}

static struct storey_response bouc_wen_shear(const double *c, const double *h, double drift) {
    double sign;
    double z = z_at(c, h, drift, &sign);
    return (struct storey_response){
        .shear = c[BACK] * drift + c[STRENGTH] * z,
        .tangent = c[BACK] + c[STRENGTH] / c[DRIFT_OF_YIELD] * slope(c, sign * z),
    };
}

static void bouc_wen_commit(const double *c, double *h, double drift) {
    double sign;
    h[Z] = z_at(c, h, drift, &sign);
    h[DRIFT] = drift;
}

// What the elastic spring holds, and the other one would give back at its initial stiffness.
static double bouc_wen_stored(const double *c, const double *h, double drift) {
    double sign;
    double z = z_at(c, h, drift, &sign);
    return (c[BACK] * drift * drift + c[STRENGTH] * c[DRIFT_OF_YIELD] * z * z) / 2.0;
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
    .shear = bouc_wen_shear,
    .commit = bouc_wen_commit,
    .stored = bouc_wen_stored,
};
