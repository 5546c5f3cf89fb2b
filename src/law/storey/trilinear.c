// SPDX-License-Identifier: GPL-3.0-or-later
// Storey of three lines, such as reinforced concrete: cracking, yield, hardening. law/points.h has
// the rules.
#include <math.h>

#include "law/lists.h"
#include "law/points.h"
#include "law/yield.h"

enum {
    CRACK,
    YIELD,
    CRACKED,
    HARDENING,
    ORIGIN,
    PEAK,
    TAKEDA,
    EXPONENT,
    PINCH_DRIFT,
    PINCH_SHEAR,
    DAMAGE_PEAK,
    DAMAGE_ENERGY,
    DAMAGE_DRIFT,
    EVERY,
    YIELD_NEGATIVE,
    N_ROW
};

static const struct range share_range = {
    .min = 0.0, .max = 1.0, .min_open = true, .max_open = true, .text = "> 0 and < 1"};
static const struct range pinch_range = {
    .min = 0.0, .max = 1.0, .min_open = true, .text = "> 0 and <= 1"};

static const struct row rows[N_ROW] = {
    [CRACK] = {"crack", ROW_LIST, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,
               "storey shear at cracking"},
    [YIELD] = YIELD_ROW,
    [CRACKED] = {"cracked", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &share_range, NAN,
                 "stiffness between cracking and yield over initial stiffness"},
    [HARDENING] = FALLING_ROW,
    [ORIGIN] = {"origin", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                "unloads and reloads through the origin"},
    [PEAK] = {"peak", ROW_FLAG, 0, OF_NONE, NULL, NAN,
              "unloads with the initial stiffness (default)"},
    [TAKEDA] = {"takeda", ROW_FLAG, 0, OF_NONE, NULL, NAN,
                "the unloading stiffness falls with the largest drift"},
    [EXPONENT] = {"b", ROW_NUMBER, 0, OF_NONE, &yield_hardening_range, 0.4,
                  "takeda: exponent of the unloading stiffness"},
    [PINCH_DRIFT] = {"pinch-drift", ROW_NUMBER, 0, OF_NONE, &pinch_range, 1.0,
                     "drift at the break of reloading, as a share; 1: no pinching"},
    [PINCH_SHEAR] = {"pinch-shear", ROW_NUMBER, 0, OF_NONE, &pinch_range, 1.0,
                     "shear at the break of reloading over that of the target"},
    [DAMAGE_PEAK] = {"damage-peak", ROW_NUMBER, 0, OF_NONE, &range_non_negative, 0.0,
                     "growth of the target with the ductility of the other direction"},
    [DAMAGE_ENERGY] = {"damage-energy", ROW_NUMBER, 0, OF_NONE, &range_non_negative, 0.0,
                       "growth of the target with the dissipated energy"},
    [DAMAGE_DRIFT] = {"damage-drift", ROW_LIST, 0, OF_LENGTH, &range_positive, NAN,
                      "drift up to which the area of the backbones counts for damage-energy"},
    [EVERY] = {"damage-every", ROW_FLAG, 0, OF_NONE, NULL, NAN,
               "damage-peak counts at every zero shear, as in OpenSees"},
    [YIELD_NEGATIVE] = YIELD_NEGATIVE_ROW,
};

static int trilinear_check(const double *value, struct error *e) {
    if (value[YIELD] <= value[CRACK]) {
        return error_set(e, STATUS_INPUT, "yield must be > crack");
    }
    if (value[HARDENING] >= value[CRACKED]) {
        return error_set(e, STATUS_INPUT, "hardening is %.6g; it must be < cracked, which is %.6g",
                         value[HARDENING], value[CRACKED]);
    }
    const int given = !isnan(value[ORIGIN]) + !isnan(value[PEAK]) + !isnan(value[TAKEDA]);
    if (given > 1) {
        return error_set(e, STATUS_INPUT, "give one of -origin, -peak and -takeda");
    }
    if (!isnan(value[ORIGIN]) && (value[PINCH_DRIFT] < 1.0 || value[PINCH_SHEAR] < 1.0 ||
                                  value[DAMAGE_PEAK] > 0.0 || value[DAMAGE_ENERGY] > 0.0)) {
        return error_set(e, STATUS_INPUT, "a storey with -origin has neither pinching nor damage");
    }
    if (value[DAMAGE_ENERGY] > 0.0 && isnan(value[DAMAGE_DRIFT])) {
        return error_set(e, STATUS_INPUT, "damage-energy needs -damage-drift");
    }
    return STATUS_OK;
}

static int trilinear_prepare(const double *value, double stiffness, double *constant,
                             struct error *e) {
    const double first = value[CRACK] / stiffness;
    const double drift[] = {first,
                            first + (value[YIELD] - value[CRACK]) / (value[CRACKED] * stiffness)};
    const double shear[] = {value[CRACK], value[YIELD]};
    points_prepare(stiffness, drift, shear, 2, value[HARDENING] * stiffness, constant);
    const int status = trilinear_check(value, e);
    if (status != STATUS_OK) {
        return status;
    }
    points_resize(constant, value[YIELD_NEGATIVE] / value[YIELD]);
    const double area =
        isnan(value[DAMAGE_DRIFT]) ? NAN : points_area(constant, value[DAMAGE_DRIFT]);
    constant[POINTS_ORIGIN] = !isnan(value[ORIGIN]);
    constant[POINTS_EXPONENT] = isnan(value[TAKEDA]) ? 0.0 : value[EXPONENT];
    constant[POINTS_PINCH_DRIFT] = value[PINCH_DRIFT];
    constant[POINTS_PINCH_SHEAR] = value[PINCH_SHEAR];
    constant[POINTS_DAMAGE_PEAK] = value[DAMAGE_PEAK];
    constant[POINTS_DAMAGE_ENERGY] = value[DAMAGE_ENERGY] > 0.0 ? value[DAMAGE_ENERGY] / area : 0.0;
    constant[POINTS_EVERY] = !isnan(value[EVERY]);
    return STATUS_OK;
}

static struct storey_response trilinear_respond(const double *c, const double *h, double drift,
                                                double *after) {
    return loading_respond(&points_rule, c, h, drift, after);
}

static double trilinear_stored(const double *c, const double *h, double drift) {
    return loading_stored(&points_rule, c, h, drift);
}

static void trilinear_describe(const double *c, struct storey_figures *out) {
    points_describe(c, 1, out);
}

const struct storey_law storey_trilinear = {
    .name = "trilinear",
    .summary = "cracking, yield and hardening; origin- or peak-oriented, pinching, damage",
    .formula =
        "backbone of slopes k to V_c, cracked k to V_y, then hardening k; unloads with k "
        "(dm / d_c)^-b, towards the origin at most, to V = 0, then aims at the largest drift dm "
        "of that direction, by a break if pinched",
    .source = "Takeda, Sozen & Nielsen (1970), J. Struct. Div. ASCE 96, 2557-2573; pinching and "
              "damage as the Hysteretic material of OpenSees (Filippou)",
    .remarks = "d_c = V_c / k. -origin dissipates only while the largest drift grows, for lightly "
               "reinforced walls and members that fail in shear. Typical for reinforced concrete: "
               "cracked 0.2 to 0.5, hardening 0.01 to 0.05, takeda with b 0.3 to 0.5, pinch-drift "
               "0.5 and pinch-shear 0.25 with strong pinching. A negative hardening leads to zero "
               "shear. Damage moves the target out; it does not lower the backbone. With "
               "yield-negative the "
               "backbone of negative drifts has drifts and shears multiplied by yield-negative / "
               "yield, cracking too",
    .example = "-crack 250kN -yield 600kN -cracked 0.3 -hardening 0.03 -takeda "
               "-pinch-drift 0.5 -pinch-shear 0.3",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = POINTS_CONSTANTS,
    .n_history = POINTS_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = trilinear_prepare,
    .respond = trilinear_respond,
    .stored = trilinear_stored,
    .describe = trilinear_describe,
};
