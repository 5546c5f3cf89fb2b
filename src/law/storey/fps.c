// SPDX-License-Identifier: GPL-3.0-or-later
// Friction pendulum: the weight W slides on a surface of radius R. The shear is that of the slope
// of the surface and of friction, which grows with the sliding velocity v:
//
//     V = (W/R) drift + S,   S = k0 (drift - slip),   |S| <= mu(|v|) W,
//     mu(v) = mu_fast - (mu_fast - mu_slow) exp(-a v).
//
// Constantinou, Mokha & Reinhorn (1990), J. Struct. Eng. 116, 455-474, equation 1. Return mapping
// gives the slip, as in bilinear.c. Where the bound becomes smaller, S is cut back to it, and the
// slip grows. v is the drift rate, also before the bearing slides, as k0 is stiff. The storey's
// initial stiffness is W/R + k0. Without a radius the surface is flat, W/R = 0. W is constant: the
// overturning moment and vertical motion are not taken into account.
#include <math.h>

#include "law/lists.h"
#include "law/yield.h"

enum { WEIGHT, RADIUS, MU, MU_SLOW, RATE, N_ROW };
enum {
    BACK,
    SPRING,
    STRENGTH,
    FALL,
    PER_VELOCITY,
    N_CONSTANT
};                         // W/R, k0, mu_fast W,
                           // (mu_fast - mu_slow) W, a
enum { SLIP, N_HISTORY };  // [L]

static const struct row rows[N_ROW] = {
    [WEIGHT] = {"weight", ROW_LIST, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,
                "weight on the sliding surface"},
    [RADIUS] = {"radius", ROW_LIST, 0, OF_LENGTH, &range_positive, NAN,
                "radius of the surface; a flat one if not given"},
    [MU] = {"mu", ROW_LIST, ROW_REQUIRED, OF_NONE, &range_positive, NAN,
            "coefficient of friction when it slides fast"},
    [MU_SLOW] = {"mu-slow", ROW_LIST, 0, OF_NONE, &range_positive, NAN,
                 "coefficient of friction when it slides slowly; mu if not given"},
    [RATE] = {"rate", ROW_LIST, 0, OF_PER_VELOCITY, &range_positive, NAN,
              "a, how fast the friction grows with the velocity; with mu-slow"},
};

static int fps_prepare(const double *value, double stiffness, double *constant, struct error *e) {
    const bool varies = !isnan(value[MU_SLOW]);
    const double slow = varies ? value[MU_SLOW] : value[MU];
    constant[BACK] = isnan(value[RADIUS]) ? 0.0 : value[WEIGHT] / value[RADIUS];
    constant[SPRING] = stiffness - constant[BACK];
    constant[STRENGTH] = value[MU] * value[WEIGHT];
    constant[FALL] = (value[MU] - slow) * value[WEIGHT];
    constant[PER_VELOCITY] = varies ? value[RATE] : 0.0;
    if (varies == isnan(value[RATE])) {
        return error_set(e, STATUS_INPUT, "give mu-slow and rate together");
    }
    if (slow > value[MU]) {
        return error_set(e, STATUS_INPUT, "mu-slow is %.6g; it must be <= mu, which is %.6g", slow,
                         value[MU]);
    }
    if (constant[SPRING] <= 0.0) {
        return error_set(e, STATUS_INPUT,
                         "the initial stiffness is %.6g; it must be > weight / radius, which is "
                         "%.6g",
                         stiffness, constant[BACK]);
    }
    return STATUS_OK;
}

static struct storey_rate_response fps_respond_at_rate(const double *c, const double *h,
                                                       double drift, double rate, double *after) {
    const double back = c[BACK] * drift;
    const double trial = c[SPRING] * (drift - h[SLIP]);
    const double fall = c[FALL] * exp(-c[PER_VELOCITY] * fabs(rate));
    const double bound = c[STRENGTH] - fall;
    const bool slides = fabs(trial) > bound;
    if (after) {
        after[SLIP] = slides ? drift - copysign(bound / c[SPRING], trial) : h[SLIP];
    }
    if (slides) {
        return (struct storey_rate_response){
            .shear = back + copysign(bound, trial),
            .tangent = c[BACK],
            .dashpot = copysign(c[PER_VELOCITY] * fall, rate) * copysign(1.0, trial),
        };
    }
    return (struct storey_rate_response){.shear = back + trial, .tangent = c[BACK] + c[SPRING]};
}

static struct storey_response fps_respond(const double *c, const double *h, double drift,
                                          double *after) {
    const struct storey_rate_response r = fps_respond_at_rate(c, h, drift, 0.0, after);
    return (struct storey_response){.shear = r.shear, .tangent = r.tangent};
}

static double fps_stored(const double *c, const double *h, double drift) {
    const double elastic = drift - h[SLIP];
    return (c[BACK] * drift * drift + c[SPRING] * elastic * elastic) / 2.0;
}

// The bearing slides fast.
static void fps_describe(const double *c, struct storey_figures *out) {
    const double drift = c[STRENGTH] / c[SPRING];
    yield_describe(drift, c[BACK] * drift + c[STRENGTH], out);
}

const struct storey_law storey_fps = {
    .name = "fps",
    .summary = "friction pendulum; its friction grows with the velocity",
    .formula = "V = (W/R) drift + S, S = k0 (drift - slip), |S| <= mu W, mu = mu_fast - (mu_fast - "
               "mu_slow) exp(-a |v|); the initial stiffness is W/R + k0",
    .source = "Constantinou, Mokha & Reinhorn (1990), J. Struct. Eng. 116, 455-474",
    .remarks =
        "for sliding bearings; the statement isolator finds the weight and the initial stiffness. "
        "Typical of PTFE on steel: mu 0.04 to 0.12, mu-slow 0.3 to 0.6 mu, rate 20 to 100 s/m. "
        "The weight is constant: the law has neither uplift nor overturning moments. Friction is "
        "the same in both directions and does not warm up. jostle law storey moves slowly without "
        "-period: it shows mu-slow",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .prepare = fps_prepare,
    .respond = fps_respond,
    .respond_at_rate = fps_respond_at_rate,
    .stored = fps_stored,
    .describe = fps_describe,
};
