// SPDX-License-Identifier: GPL-3.0-or-later
// Storey that slips: an elastic spring W k beside two hooks of stiffness (1 - W) k, one for each
// direction, which catch after a slack g and yield. A hook that has yielded by p catches at g + p:
//
//     V = W k drift + F(drift, p+) - F(-drift, p-),
//     F = max(0, min((1 - W) k (d - g - p), Y + H p)).
//
// The shear at first yield is V_y = W k d_y + Y with d_y = g + Y / ((1 - W) k). The slope beyond is
// R k. The force has kinks where a hook catches and where it yields. All steps without a turn are
// exact.
#include <math.h>

#include "law/lists.h"
#include "law/yield.h"

enum { YIELD, HARDENING, SLACK, WEAK, N_ROW };
enum { BACK, SPRING, STRENGTH, HARD, GAP, N_CONSTANT };
enum { RIGHT, LEFT, N_HISTORY };  // p of each hook

static const struct range weak_range = {
    .min = 0.0, .max = 1.0, .min_open = true, .max_open = true, .text = "> 0 and < 1"};

static const struct row rows[N_ROW] = {
    [YIELD] = YIELD_ROW,
    [HARDENING] = HARDENING_ROW,
    [SLACK] = {"slack", ROW_LIST, 0, OF_LENGTH, &range_non_negative, 0.0,
               "drift at which a hook catches at first"},
    [WEAK] = {"weak", ROW_NUMBER, 0, OF_NONE, &weak_range, 0.05,
              "stiffness while it slips over initial stiffness"},
};

static int slip_prepare(const double *value, double stiffness, double *constant, struct error *e) {
    const double weak = value[WEAK] * stiffness, hook = stiffness - weak;
    if (value[HARDENING] < value[WEAK]) {
        return error_set(e, STATUS_INPUT, "hardening is %.6g; it must be >= weak, which is %.6g",
                         value[HARDENING], value[WEAK]);
    }
    const double strength = (value[YIELD] - weak * value[SLACK]) * (1.0 - value[WEAK]);
    if (strength <= 0.0) {
        return error_set(e, STATUS_INPUT,
                         "yield is reached within the slack; it must be > weak k slack");
    }
    // In series with the hook's spring the slope H makes R k - W k.
    const double slope = (value[HARDENING] - value[WEAK]) * stiffness;
    constant[BACK] = weak;
    constant[SPRING] = hook;
    constant[STRENGTH] = strength;
    constant[HARD] = slope * hook / (hook - slope);
    constant[GAP] = value[SLACK];
    return STATUS_OK;
}

static struct storey_response slip_respond(const double *c, const double *h, double drift,
                                           double *after) {
    const int side = drift < 0.0 ? LEFT : RIGHT;
    const double size = fabs(drift), p = h[side];
    double force = fmax(0.0, c[SPRING] * (size - c[GAP] - p)),
           slope = force > 0.0 ? c[SPRING] : 0.0;
    double moved = p;
    if (force > c[STRENGTH] + c[HARD] * p) {
        moved = (c[SPRING] * (size - c[GAP]) - c[STRENGTH]) / (c[SPRING] + c[HARD]);
        force = c[STRENGTH] + c[HARD] * moved;
        slope = c[SPRING] * c[HARD] / (c[SPRING] + c[HARD]);
    }
    if (after) {
        after[!side] = h[!side];
        after[side] = moved;
    }
    return (struct storey_response){.shear = c[BACK] * drift + copysign(force, drift),
                                    .tangent = c[BACK] + slope};
}

static double slip_stored(const double *c, const double *h, double drift) {
    const double back = c[BACK] * drift;
    const double hook = slip_respond(c, h, drift, NULL).shear - back;
    return back * drift / 2.0 + hook * hook / (2.0 * c[SPRING]);
}

static void slip_describe(const double *c, struct storey_figures *out) {
    const double drift = c[GAP] + c[STRENGTH] / c[SPRING];
    yield_describe(drift, c[BACK] * drift + c[STRENGTH], out);
}

const struct storey_law storey_slip = {
    .name = "slip",
    .summary = "catches after a slack that grows as the storey yields; weak between",
    .formula =
        "V = W k drift + F(drift, p+) - F(-drift, p-), F = max(0, min((1 - W) k (d - g - p), Y "
        "+ H p)), p grows where the hook yields, so that the slope is R k",
    .source =
        "two elastic-plastic springs with a gap that grows, as ElasticPPGap of OpenSees with "
        "damage; slip of braces and timber: Stewart (1987), PhD thesis, University of Canterbury",
    .remarks =
        "for tension-only braces, bolted and nailed timber, masonry infill. k is the stiffness "
        "with a hook that has caught: with a slack, first steps and modes have k, the storey "
        "has W k. hardening must be >= weak. Typical: weak 0.01 to 0.1, hardening 0.05 to 0.1. "
        "A storey that slips freely back and forth dissipates nothing",
    .example = "-yield 600kN -hardening 0.1 -slack 4mm",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .n_history = N_HISTORY,
    .traits = STOREY_STRAIGHT,
    .prepare = slip_prepare,
    .respond = slip_respond,
    .stored = slip_stored,
    .describe = slip_describe,
};
