// SPDX-License-Identifier: GPL-3.0-or-later
// Takeda's storey with a bilinear backbone, for reinforced concrete that is cracked from the start.
// The unloading stiffness decreases with the largest drift. Reloading aims at less than the largest
// drift (law/peak_oriented.h). The backbone of Takeda, Sozen & Nielsen has a third line, from
// cracking to yield. Clough's storey is the same with alpha = beta = 0: it unloads with the initial
// stiffness, and reloads towards the largest drift.

#include "law/lists.h"
#include "law/peak_oriented.h"
#include "law/yield.h"

enum { YIELD, HARDENING, ALPHA, BETA, YIELD_NEGATIVE, N_ROW };

static const struct range share = {
    .min = 0.0, .max = 1.0, .max_open = true, .text = ">= 0 and < 1"};

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = FALLING_ROW,
    [ALPHA] = {"alpha", ROW_NUMBER, 0, OF_NONE, &share, 0.4, "exponent of the unloading stiffness"},
    [BETA] = {"beta", ROW_NUMBER, 0, OF_NONE, &share, 0.0, "reloading aims at D - beta (D - d_y)"},
    [YIELD_NEGATIVE] = YIELD_NEGATIVE_ROW,
};

static const struct row clough_rows[] = {YIELD_ROW, FALLING_ROW, YIELD_NEGATIVE_ROW};
enum { N_CLOUGH_ROW = sizeof clough_rows / sizeof clough_rows[0] };

static int takeda_prepare(const double *value, double stiffness, double *constant,
                          struct error *e) {
    (void)e;
    const double own[PEAK_ORIENTED_CONSTANTS] = {
        [PEAK_ORIENTED_STIFFNESS] = stiffness,
        [PEAK_ORIENTED_YIELD] = value[YIELD],
        [PEAK_ORIENTED_HARDENING] = value[HARDENING],
        [PEAK_ORIENTED_ALPHA] = value[ALPHA],
        [PEAK_ORIENTED_BETA] = value[BETA],
        [PEAK_ORIENTED_YIELD_LEFT] = value[YIELD_NEGATIVE],
    };
    peak_oriented_prepare(own, constant);
    return STATUS_OK;
}

static int clough_prepare(const double *value, double stiffness, double *constant,
                          struct error *e) {
    const double all[N_ROW] = {
        [YIELD] = value[0], [HARDENING] = value[1], [YIELD_NEGATIVE] = value[2]};
    return takeda_prepare(all, stiffness, constant, e);
}

const struct storey_law storey_takeda = {
    .name = "takeda",
    .summary = "bilinear; unloading and reloading become softer with the largest drift so far",
    .formula = "unloading with k (d_y / D)^alpha, at most towards the origin, to V = 0; then a "
               "straight line to D - beta (D - d_y) on the backbone V_y + R k (drift - d_y), not "
               "stiffer than the unloading; D is the largest drift so far in that direction",
    .source = "Takeda, Sozen & Nielsen (1970), J. Struct. Div. ASCE 96, 2557-2573; bilinear form "
              "of Otani (1974), Univ. Illinois SRS 413",
    .remarks =
        "For reinforced concrete. Typical: alpha 0.3 to 0.5, beta 0 to 0.6, hardening 0.01 to "
        "0.1; k is the cracked stiffness. It neither pinches nor loses strength in cycles "
        "(trilinear, imk). With a negative hardening the backbone falls to V = 0 and stays there",
    .example = "-yield 600kN -hardening 0.05 -alpha 0.4 -beta 0.2",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = PEAK_ORIENTED_CONSTANTS,
    .n_history = PEAK_ORIENTED_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = takeda_prepare,
    .respond = peak_oriented_respond,
    .stored = peak_oriented_stored,
    .describe = peak_oriented_describe,
};

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
    .row = clough_rows,
    .n_row = N_CLOUGH_ROW,
    .n_constant = PEAK_ORIENTED_CONSTANTS,
    .n_history = PEAK_ORIENTED_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = clough_prepare,
    .respond = peak_oriented_respond,
    .stored = peak_oriented_stored,
    .describe = peak_oriented_describe,
};
