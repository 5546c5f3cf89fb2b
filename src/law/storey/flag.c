// SPDX-License-Identifier: GPL-3.0-or-later
// Self-centring storey: an elastic spring R k beside a spring (1 - R) k in series with a device
// that yields outwards at the drift D = V_y / k and returns at (1 - b) D:
//
//     V = R k drift + (1 - R) k (drift - p),
//     max(0, drift - D) <= p <= max(0, drift - (1 - b) D) for drift > 0, mirrored for drift < 0.
//
// p stays as it is unless a bound moves it. With b <= 1 no drift remains at V = 0. All steps
// without a turn are exact. An excursion to d > D and back dissipates b V_y (1 - R) (d - D).
#include <math.h>

#include "law/lists.h"
#include "law/yield.h"

enum { YIELD, HARDENING, B, N_ROW };
enum { BACK, SPRING, OUT, IN, N_CONSTANT };  // R k, (1 - R) k, D, (1 - b) D
enum { REST, N_HISTORY };                    // p

static const struct range flag_range = {.min = 0.0, .max = 1.0, .text = ">= 0 and <= 1"};

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = HARDENING_ROW,
    [B] = {"b", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &flag_range, NAN,
           "height of the flag over the shear at yield"},
};

static int flag_prepare(const double *value, double stiffness, double *constant, struct error *e) {
    (void)e;
    constant[BACK] = value[HARDENING] * stiffness;
    constant[SPRING] = (1.0 - value[HARDENING]) * stiffness;
    constant[OUT] = value[YIELD] / stiffness;
    constant[IN] = (1.0 - value[B]) * constant[OUT];
    return STATUS_OK;
}

static struct storey_response flag_respond(const double *c, const double *h, double drift,
                                           double *after) {
    const double size = fabs(drift);
    const double own = drift < 0.0 ? -h[REST] : h[REST];
    const double rest = fmin(fmax(own, fmax(0.0, size - c[OUT])), fmax(0.0, size - c[IN]));
    const bool moves = rest != own;
    if (after) {
        after[REST] = moves ? copysign(rest, drift) : h[REST];
    }
    // A bound of 0 stands, the others move with the drift.
    const bool stands = !moves || rest == 0.0;
    return (struct storey_response){
        .shear = c[BACK] * drift + c[SPRING] * copysign(size - rest, drift),
        .tangent = c[BACK] + (stands ? c[SPRING] : 0.0),
    };
}

static double flag_stored(const double *c, const double *h, double drift) {
    double rest = 0.0;
    flag_respond(c, h, drift, &rest);
    const double size = fabs(drift), p = fabs(rest);
    // Coming back, the spring gives back its energy, and p returns against the shear (1 - b) V_y.
    const double elastic = size - p;
    return (c[BACK] * size * size + c[SPRING] * elastic * elastic) / 2.0 + c[SPRING] * c[IN] * p;
}

static void flag_describe(const double *c, struct storey_figures *out) {
    yield_describe(c[OUT], (c[BACK] + c[SPRING]) * c[OUT], out);
}

const struct storey_law storey_flag = {
    .name = "flag",
    .summary = "self-centring: returns to drift 0 along a flag-shaped loop",
    .formula = "V = R k drift + (1 - R) k (drift - p), D - b D <= drift - p <= D where p > 0, "
               "drift - p <= D where p = 0, D = V_y / k; mirrored for negative drifts",
    .source =
        "Christopoulos, Filiatrault & Folz (2002), Earthquake Eng. Struct. Dyn. 31, 1131-1150",
    .remarks =
        "for post-tensioned rocking walls and frames, shape memory alloys and ring springs. "
        "Typical: hardening 0.02 to 0.2, b 0.3 to 0.9. b = 0 is elastic with two slopes. The "
        "tendons neither yield nor break: check the largest drift",
    .example = "-yield 600kN -hardening 0.05 -b 0.8",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = flag_prepare,
    .respond = flag_respond,
    .stored = flag_stored,
    .describe = flag_describe,
};
