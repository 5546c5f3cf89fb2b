// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys with a backbone through points, whose reloading aims at the largest drift dm reached so
// far in that direction. The backbone of negative drifts is the other one in another size. Of one
// direction, drift and shear positive:
//
//     unloading  K = k min(1, (dm / d1)^-b), towards the origin at most, or always to the origin;
//     reloading  from z to the break (z + pX (dm - (1 - pY) Fm / K - z), pY Fm), then to (dm, Fm)
//     on
//                the backbone, never steeper than K;
//     damage     dm *= 1 + damage_energy E / E_A + damage_peak (dm' / d1 - 1) at zero shear, if the
//                other direction has yielded. dm' is its largest drift, E the energy dissipated so
//                far, E_A the area below both backbones up to a given drift.
//
// The part of dm' counts once for each new dm', or at every zero shear as in the Hysteretic
// material of OpenSees (Filippou), which has these rules.
#ifndef JOSTLE_POINTS_H
#define JOSTLE_POINTS_H

#include "law/loading.h"

enum { POINTS_MAX = 6 };

enum points_constant {
    POINTS_N = LOADING_CONSTANTS,
    POINTS_DRIFT,
    POINTS_SHEAR = POINTS_DRIFT + POINTS_MAX,
    POINTS_SLOPE = POINTS_SHEAR + POINTS_MAX,  // beyond each point
    POINTS_ORIGIN = POINTS_SLOPE + POINTS_MAX,
    POINTS_EXPONENT,     // b
    POINTS_PINCH_DRIFT,  // pX
    POINTS_PINCH_SHEAR,  // pY
    POINTS_DAMAGE_PEAK,
    POINTS_DAMAGE_ENERGY,  // over E_A
    POINTS_EVERY,          // the damage of the peak counts at every zero shear
    POINTS_LEFT,           // size of the backbone of negative drifts
    POINTS_CONSTANTS
};

enum points_history {
    POINTS_LARGEST = LOADING_OWN,         // dm to the right, to the left
    POINTS_COUNTED = POINTS_LARGEST + 2,  // those that have done their damage
    POINTS_ENERGY = POINTS_COUNTED + 2,
    POINTS_PATH,
    POINTS_HISTORY = POINTS_PATH + LOADING_PATH_SIZE
};

// Sets the backbone from `n` points of drift and shear, with the slope `last` beyond, and the rules
// to peak-oriented ones. The first point ends the line of the initial stiffness.
void points_prepare(double stiffness, const double *drift, const double *shear, int n, double last,
                    double *constant);

// Gives the backbone of negative drifts the size `left`, with the points of each drift and shear
// multiplied by it; NAN: it is the same.
void points_resize(double *constant, double left);

// The size of the backbone of the direction `at`: 0 right, 1 left.
static inline double points_size(const double *constant, int at) {
    return at == 0 ? 1.0 : constant[POINTS_LEFT];
}

// Area below both backbones up to `drift`.
double points_area(const double *constant, double drift);

// The yield is at point `i`.
void points_describe(const double *constant, int i, struct storey_figures *out);

extern const struct loading_rule points_rule;

#endif
