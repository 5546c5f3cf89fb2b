// SPDX-License-Identifier: GPL-3.0-or-later
// Storey of Ibarra, Medina & Krawinkler: it hardens, loses strength beyond a capping drift, keeps a
// residual strength, and deteriorates with the energy that it dissipates. src/law/imk.h has the
// rules; this file has the parameters.
#include <math.h>

#include "law/imk.h"
#include "law/lists.h"
#include "law/yield.h"

enum {
    YIELD,
    HARDENING,
    CAPPING,
    POST_CAPPING,
    RESIDUAL,
    ULTIMATE,
    SHARE,
    N_SIDE,
    LEFT = N_SIDE,  // the same rows of the negative direction
    GAMMA = 2 * N_SIDE,
    EXPONENT = GAMMA + IMK_MODES,
    CYCLE = EXPONENT + IMK_MODES,
    KF,
    KD,
    RELOAD,
    SUM,
    SLOPE,
    LIMIT,
    EXHAUSTED,
    LOST_SIDES,
    N_ROW
};

static const struct range hardening_range = {.min = -0.1, .max = 0.9, .text = ">= -0.1 and <= 0.9"};
static const struct range falling_range = {
    .min = -10.0, .max = 0.0, .max_open = true, .text = ">= -10 and < 0"};
static const struct range share_range = {.min = 0.0, .max = 1.0, .text = ">= 0 and <= 1"};
static const struct range exponent_range = {.min = 0.5, .max = 3.0, .text = ">= 0.5 and <= 3"};

#define CHOICE(name, said, ...)                                                                    \
    static const char *const name##_word[] = {__VA_ARGS__, NULL};                                  \
    static const struct range name##_range = {.text = said, .word = name##_word}
CHOICE(cycle, "bilinear, peak or pinched", "bilinear", "peak", "pinched");
CHOICE(reload, "global or local", "global", "local");
CHOICE(sum, "present or earlier", "present", "earlier");
CHOICE(slope, "excursion or compound", "excursion", "compound");
CHOICE(limit, "on or off", "on", "off");
CHOICE(exhausted, "lost or residual", "lost", "residual");
CHOICE(sides, "one or both", "one", "both");

// `side` is "" or "-negative". A value of the negative direction that is not given is that of the
// positive one.
#define SIDE_ROWS(at, side, required, zero, whole, of)                                             \
    [(at) + YIELD] = ROW_OF("yield" side, ROW_LIST, required, OF_FORCE, &range_positive, NAN,      \
                            "storey shear at first yield" of),                                     \
            [(at) + HARDENING] =                                                                   \
                ROW_OF("hardening" side, ROW_NUMBER, required, OF_NONE, &hardening_range, NAN,     \
                       "stiffness after yield over initial stiffness" of),                         \
            [(at) + CAPPING] = ROW_OF("capping" side, ROW_LIST, 0, OF_LENGTH, &range_positive,     \
                                      NAN, "drift beyond which the strength falls" of),            \
            [(at) + POST_CAPPING] =                                                                \
                ROW_OF("post-capping" side, ROW_NUMBER, 0, OF_NONE, &falling_range, NAN,           \
                       "stiffness beyond capping over initial stiffness" of),                      \
            [(at) + RESIDUAL] = ROW_OF("residual" side, ROW_NUMBER, 0, OF_NONE, &share_range,      \
                                       zero, "residual strength over yield strength" of),          \
            [(at) + ULTIMATE] = ROW_OF("ultimate" side, ROW_LIST, 0, OF_LENGTH, &range_positive,   \
                                       NAN, "drift at which all strength is lost" of),             \
            [(at) + SHARE] = ROW_OF("D" side, ROW_NUMBER, 0, OF_NONE, &share_range, whole,         \
                                    "share of the deterioration of strength and target" of)

#define MODE_ROWS(mode, letter, what)                                                              \
    [GAMMA + (mode)] = ROW_OF("gamma-" letter, ROW_NUMBER, 0, OF_NONE, &range_positive, NAN,       \
                              "energy capacity for " what " over V_y d_y; off if not given"),      \
             [EXPONENT + (mode)] = ROW_OF("c-" letter, ROW_NUMBER, 0, OF_NONE, &exponent_range,    \
                                          1.0, "exponent of gamma-" letter)

static const struct row rows[N_ROW] = {
    SIDE_ROWS(0, "", ROW_REQUIRED, 0.0, 1.0, ""),
    SIDE_ROWS(LEFT, "-negative", 0, NAN, NAN, " of negative drifts (default: as above)"),
    MODE_ROWS(IMK_STRENGTH, "s", "the yield strength and hardening"),
    MODE_ROWS(IMK_CAPPING, "c", "the strength beyond capping"),
    MODE_ROWS(IMK_TARGET, "a", "the target of reloading"),
    MODE_ROWS(IMK_UNLOADING, "k", "the unloading stiffness"),
    [CYCLE] =
        ROW_OF("cycle", ROW_CHOICE, 0, OF_NONE, &cycle_range, IMK_PEAK, "how the storey reloads"),
    [KF] = ROW_OF("kf", ROW_NUMBER, 0, OF_NONE, &share_range, 0.25,
                  "pinched: force at the break, over the target's"),
    [KD] = ROW_OF("kd", ROW_NUMBER, 0, OF_NONE, &share_range, 0.25,
                  "pinched: 1 - drift at the break, over the permanent drift of the target"),
    [RELOAD] =
        ROW_OF("reload", ROW_CHOICE, 0, OF_NONE, &reload_range, NAN,
               "peak: local aims first at the last turn of that side (default); pinched: behind "
               "the break (default global)"),
    [SUM] = ROW_OF(
        "sum", ROW_CHOICE, 0, OF_NONE, &sum_range, 0.0,
        "excursions whose energy lessens the capacity: with the present one, or earlier ones "
        "only"),
    [SLOPE] =
        ROW_OF("ku", ROW_CHOICE, 0, OF_NONE, &slope_range, 0.0,
               "the unloading stiffness falls from that of the excursion's start, or at each turn"),
    [LIMIT] = ROW_OF("strength-limit", ROW_CHOICE, 0, OF_NONE, &limit_range, 0.0,
                     "bilinear: strength lost beyond capping does not return"),
    [EXHAUSTED] = ROW_OF("exhausted", ROW_CHOICE, 0, OF_NONE, &exhausted_range, 0.0,
                         "strength after a capacity is used up"),
    [LOST_SIDES] = ROW_OF("ultimate-sides", ROW_CHOICE, 0, OF_NONE, &sides_range, 0.0,
                          "directions that lose their strength at -ultimate"),
};

// The constants of one direction, from its values.
static int imk_prepare_side(const double *value, double stiffness, const char *side, double *c,
                            struct error *e) {
    const double drift = value[YIELD] / stiffness;
    const double hard = value[HARDENING] * stiffness;
    if (isnan(value[CAPPING]) != isnan(value[POST_CAPPING])) {
        return error_set(e, STATUS_INPUT, "capping%s and post-capping%s must be given together",
                         side, side);
    }
    if (value[CAPPING] < drift) {
        return error_set(e, STATUS_INPUT,
                         "capping%s is less than the drift at yield, yield / stiffness", side);
    }
    if (value[ULTIMATE] <= drift) {
        return error_set(e, STATUS_INPUT,
                         "ultimate%s must be more than the drift at yield, yield / stiffness",
                         side);
    }
    if (value[POST_CAPPING] >= value[HARDENING]) {
        return error_set(e, STATUS_INPUT, "post-capping%s is %.6g; it must be < hardening%s", side,
                         value[POST_CAPPING], side);
    }
    c[IMK_YIELD] = value[YIELD];
    c[IMK_HARDENING] = hard;
    c[IMK_FALL] = isnan(value[CAPPING]) ? 0.0 : value[POST_CAPPING] * stiffness;
    c[IMK_REFERENCE] = isnan(value[CAPPING]) ? INFINITY
                                             : value[YIELD] + hard * (value[CAPPING] - drift) -
                                                   c[IMK_FALL] * value[CAPPING];
    c[IMK_RESIDUAL] = value[RESIDUAL] * value[YIELD];
    c[IMK_ULTIMATE] = isnan(value[ULTIMATE]) ? INFINITY : value[ULTIMATE];
    c[IMK_SHARE] = value[SHARE];
    return STATUS_OK;
}

static int imk_prepare(const double *value, double stiffness, double *constant, struct error *e) {
    double left[N_SIDE];
    for (int i = 0; i < N_SIDE; i++) {
        left[i] = isnan(value[LEFT + i]) ? value[i] : value[LEFT + i];
    }
    int status = imk_prepare_side(value, stiffness, "", constant + IMK_RIGHT, e);
    if (status == STATUS_OK) {
        status = imk_prepare_side(left, stiffness, "-negative", constant + IMK_LEFT, e);
    }
    const double area = value[YIELD] * value[YIELD] / stiffness;
    for (int m = 0; m < IMK_MODES; m++) {
        const double gamma = value[GAMMA + m];
        constant[IMK_CAPACITY + m] = isnan(gamma) ? INFINITY : gamma * area;
        constant[IMK_EXPONENT + m] = value[EXPONENT + m];
    }
    const bool pinched = value[CYCLE] == IMK_PINCHED;
    constant[LOADING_STIFFNESS] = stiffness;
    constant[LOADING_YIELD] = value[YIELD] / stiffness;
    constant[LOADING_YIELD_LEFT] = left[YIELD] / stiffness;
    constant[IMK_CYCLE] = value[CYCLE];
    constant[IMK_KF] = value[KF];
    constant[IMK_KD] = value[KD];
    constant[IMK_LOCAL] = isnan(value[RELOAD]) ? !pinched : value[RELOAD];
    constant[IMK_EARLIER] = value[SUM];
    constant[IMK_COMPOUND] = value[SLOPE];
    constant[IMK_UNLIMITED] = value[LIMIT];
    constant[IMK_KEEPS] = value[EXHAUSTED];
    constant[IMK_BOTH] = value[LOST_SIDES];
    constant[IMK_NOISE] = 1e-12 * area;
    return status;
}

static struct storey_response imk_respond(const double *c, const double *h, double drift,
                                          double *after) {
    return loading_respond(&imk_rule, c, h, drift, after);
}

static double imk_stored(const double *c, const double *h, double drift) {
    return loading_stored(&imk_rule, c, h, drift);
}

static void imk_describe(const double *c, struct storey_figures *out) {
    for (int i = 0; i < 2; i++) {
        const double *side = c + (i == 0 ? IMK_RIGHT : IMK_LEFT);
        out->yield[i] = side[IMK_YIELD] / c[LOADING_STIFFNESS];
        out->strength[i] = side[IMK_YIELD];
        out->ultimate[i] = side[IMK_ULTIMATE];
    }
    for (int m = 0; m < IMK_MODES; m++) {
        out->capacity = fmin(out->capacity, c[IMK_CAPACITY + m]);
    }
}

// That of the excursions, the present one too.
static double imk_consumed(const double *c, const double *h) {
    if (h[LOADING_SIDE] == 0.0) {
        return 0.0;
    }
    const double shear = h[LOADING_SHEAR];
    const double present = h[LOADING_WORK] - shear * shear / (2.0 * h[LOADING_SLOPE]);
    return h[IMK_SUM] + (present > c[IMK_NOISE] ? present : 0.0);
}

const struct storey_law storey_imk = {
    .name = "imk",
    .summary = "Ibarra, Medina & Krawinkler: capping, residual strength, cyclic deterioration",
    .formula = "backbone max(min(V_y + R k (drift - d_y), V_ref + a k drift), residual V_y), a < 0 "
               "beyond capping; after an excursion of energy E, strengths and unloading stiffness "
               "fall by 1 - (E / (gamma V_y d_y - sum of E))^c",
    .source = "Ibarra, Medina & Krawinkler (2005), Earthquake Eng. Struct. Dyn. 34, 1489-1511; "
              "partial reloading as Mahin & Bertero (1976), J. Struct. Div. ASCE 102, 1125-1139",
    .remarks =
        "d_y = V_y / k. Typical: hardening 0.03, capping 2 to 6 d_y, post-capping -0.05 to -0.5, "
        "residual 0 to 0.2; gamma 25 (rapid), 50, 100 (slow deterioration); kf = kd = 0.25 for "
        "strong pinching. gamma counts from V_y of positive drifts. Some programs take gamma as an "
        "energy over V_y (a drift) or double gamma-k: convert their values. bilinear is for steel, "
        "peak for reinforced concrete, pinched for walls, timber and shear failures. The slope "
        "beyond capping is negative, so drifts depend strongly on the motion there. bilinear: "
        "where the hardening line of a direction is below 0, the shear stays 0. A lower unloading "
        "stiffness at a turn gives back a small part of the energy already counted as dissipated. "
        "The "
        "rules are those of programs of the authors' group; where programs disagree, an option has "
        "the other rule",
    .example = "-yield 600kN -hardening 0.03 -capping 40mm -post-capping -0.1 "
               "-residual 0.2 -cycle pinched -gamma-s 80 -gamma-c 80 -gamma-a 80 -gamma-k 80",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = IMK_CONSTANTS,
    .n_history = IMK_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = imk_prepare,
    .respond = imk_respond,
    .stored = imk_stored,
    .describe = imk_describe,
    .consumed = imk_consumed,
};
