// SPDX-License-Identifier: GPL-3.0-or-later
// Clough's storey: bilinear backbone, unloading with the initial stiffness, and reloading towards
// the largest drift so far (law/peak_oriented.h with alpha = beta = 0).

#include "law/lists.h"
#include "law/peak_oriented.h"
#include "law/yield.h"

enum { YIELD, HARDENING, YIELD_NEGATIVE, N_ROW };

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = FALLING_ROW,
    [YIELD_NEGATIVE] = YIELD_NEGATIVE_ROW,
};

static int clough_prepare(const double *value, double stiffness, double *constant,
                          struct error *e) {
    const double own[PEAK_ORIENTED_CONSTANTS] = {
        [PEAK_ORIENTED_STIFFNESS] = stiffness,
        [PEAK_ORIENTED_YIELD] = value[YIELD],
        [PEAK_ORIENTED_HARDENING] = value[HARDENING],
        [PEAK_ORIENTED_YIELD_LEFT] = value[YIELD_NEGATIVE],
    };
    return peak_oriented_prepare(own, constant, e);
}

const struct storey_law storey_clough = {
    .name = "clough",
    .summary = "bilinear; reloads towards the largest drift so far",
    .formula = "unloading with k to V = 0, then a straight line to the point of the largest drift "
               "so far in that direction, on the backbone V_y + R k (drift - d_y)",
    .source = "Clough & Johnston (1966), Proc. Japan Earthquake Eng. Symposium, 227-232; partial "
              "unloading as Mahin & Bertero (1976), J. Struct. Div. ASCE 102, 1125-1139",
    .remarks =
        "For reinforced concrete in bending with little shear. Typical: hardening 0.01 to 0.1. "
        "It unloads with k at any drift, and does not pinch: large cycles dissipate too much "
        "(takeda, imk). With a negative hardening the backbone falls to V = 0 and stays there",
    .example = "-yield 600kN -hardening 0.05",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = PEAK_ORIENTED_CONSTANTS,
    .n_history = PEAK_ORIENTED_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = clough_prepare,
    .respond = peak_oriented_respond,
    .stored = peak_oriented_stored,
    .describe = peak_oriented_describe,
};
