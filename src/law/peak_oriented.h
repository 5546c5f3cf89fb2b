// SPDX-License-Identifier: GPL-3.0-or-later
// Storeys whose stiffness degrades: a bilinear backbone, unloading straight to zero shear, and
// reloading towards the largest drift reached so far in that direction. Shared by the laws that
// differ in how unloading and reloading degrade:
//
//     unloading stiffness  k (d_y / D)^alpha, towards V = 0 at drift 0 at most,
//                          D >= d_y the largest drift of that side,
//     reloading aims at    D - beta (D - d_y)      on the backbone.
//
// A storey that is partly unloaded and loaded again returns along the unloading line (Mahin &
// Bertero 1976, J. Struct. Div. ASCE 102, 1125-1139), then continues on its former path. Reloading
// is never stiffer than unloading. Each direction may have its own V_y. With R < 0 the backbone
// ends at V = 0.
#ifndef JOSTLE_PEAK_ORIENTED_H
#define JOSTLE_PEAK_ORIENTED_H

#include "jostle/storey_law.h"

enum peak_oriented_constant {
    PEAK_ORIENTED_STIFFNESS,   // k
    PEAK_ORIENTED_YIELD,       // V_y
    PEAK_ORIENTED_YIELD_LEFT,  // of negative drifts
    PEAK_ORIENTED_HARDENING,   // R
    PEAK_ORIENTED_ALPHA,
    PEAK_ORIENTED_BETA,
    PEAK_ORIENTED_YIELD_DRIFT,  // V_y / k, which peak_oriented_prepare fills in
    PEAK_ORIENTED_YIELD_DRIFT_LEFT,
    PEAK_ORIENTED_CONSTANTS
};
enum { PEAK_ORIENTED_HISTORY = 6 };

// A YIELD_LEFT that is NAN becomes YIELD.
void peak_oriented_prepare(const double value[PEAK_ORIENTED_CONSTANTS], double *constant);

// respond, stored and describe of the descriptors.
struct storey_response peak_oriented_respond(const double *constant, const double *history,
                                             double drift, double *after);
double peak_oriented_stored(const double *constant, const double *history, double drift);
void peak_oriented_describe(const double *constant, struct storey_figures *out);

#endif
