// SPDX-License-Identifier: GPL-3.0-or-later
// Bilinear storey with kinematic hardening: an elastic spring R k beside an elastic, perfectly
// plastic spring of stiffness (1 - R) k and strength (1 - R) V_y. V_y is the storey shear at first
// yield.
//
//     V = R k drift + S,   S = (1 - R) k (drift - plastic),   |S| <= (1 - R) V_y.
//
// Each direction may have its own V_y. With R < 0 the elastic spring pushes the storey over.
//
// Return mapping gives the plastic drift: the trial S is limited to the strength (Simo & Hughes
// 1998, Computational Inelasticity, chapter 1). It is exact if the drift does not reverse within a
// step. The tangent is k or R k and jumps between both. R = 0 is elastoplastic.
#include <math.h>

#include "law/lists.h"
#include "law/yield.h"

enum { YIELD, HARDENING, YIELD_NEGATIVE, N_ROW };
enum { BACK, SPRING, STRENGTH, STRENGTH_NEGATIVE, N_CONSTANT };  // R k, (1 - R) k, (1 - R) V_y
enum { PLASTIC, N_HISTORY };                                     // plastic drift [L]

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = FALLING_ROW,
    [YIELD_NEGATIVE] = YIELD_NEGATIVE_ROW,
};

static int bilinear_prepare(const double *value, double stiffness, double *constant,
                            struct error *e) {
    (void)e;
    // Both springs together are k to the last bit, for which buildings are factorised at first.
    const double r = value[HARDENING], negative = value[YIELD_NEGATIVE];
    constant[SPRING] = stiffness - r * stiffness;
    constant[BACK] = stiffness - constant[SPRING];
    constant[STRENGTH] = (1.0 - r) * value[YIELD];
    constant[STRENGTH_NEGATIVE] = (1.0 - r) * (isnan(negative) ? value[YIELD] : negative);
    return STATUS_OK;
}

static struct storey_response bilinear_respond(const double *c, const double *h, double drift,
                                               double *after) {
    const double back = c[BACK] * drift;
    const double trial = c[SPRING] * (drift - h[PLASTIC]);
    const double strength = c[trial < 0.0 ? STRENGTH_NEGATIVE : STRENGTH];
    const bool yields = fabs(trial) > strength;
    if (after) {
        after[PLASTIC] = yields ? drift - copysign(strength / c[SPRING], trial) : h[PLASTIC];
    }
    if (yields) {
        return (struct storey_response){.shear = back + copysign(strength, trial),
                                        .tangent = c[BACK]};
    }
    return (struct storey_response){.shear = back + trial, .tangent = c[BACK] + c[SPRING]};
}

// The limit of a line holds in both directions.
static struct storey_branch bilinear_branch(const double *c, const double *h) {
    return (struct storey_branch){c[BACK], c[SPRING], h[PLASTIC],
                                  fmin(c[STRENGTH], c[STRENGTH_NEGATIVE])};
}

static double bilinear_stored(const double *c, const double *h, double drift) {
    double elastic = drift - h[PLASTIC];
    return (c[BACK] * drift * drift + c[SPRING] * elastic * elastic) / 2.0;
}

static void bilinear_describe(const double *c, struct storey_figures *out) {
    for (int i = 0; i < 2; i++) {
        const double drift = c[STRENGTH + i] / c[SPRING];
        out->yield[i] = drift;
        out->strength[i] = (c[BACK] + c[SPRING]) * drift;
    }
}

const struct storey_law storey_bilinear = {
    .name = "bilinear",
    .summary = "bilinear with kinematic hardening; elastic-plastic with -hardening 0",
    .formula = "V = R k drift + S, S = (1 - R) k (drift - plastic), |S| <= (1 - R) V_y",
    .source = "Simo & Hughes (1998), Computational Inelasticity, section 1.4",
    .remarks =
        "For steel frames, buckling-restrained braces and isolators. Typical: hardening 0.01 "
        "to 0.05, isolators 0.05 to 0.2. Neither stiffness nor strength deteriorates: for "
        "reinforced concrete it dissipates too much. A negative hardening has no end: beyond d_y "
        "(1 + 1 / |R|) the shear pushes the "
        "storey over. Give `collapse drift` less than that",
    .example = "-yield 600kN -hardening 0.05",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = bilinear_prepare,
    .respond = bilinear_respond,
    .branch = bilinear_branch,
    .stored = bilinear_stored,
    .describe = bilinear_describe,
};
