// SPDX-License-Identifier: GPL-3.0-or-later
// Bouc & Wen's storey that wears (storey/bouc_wen.c has the one that does not).
//
// Degradation (Baber & Wen 1981) and pinching (Baber & Noori 1986, Foliente 1995) follow the energy
// e = (1 - R) int z ds, work of the yielding part over V_y d_y:
//
//     dz/ds = h (A + nu m |z|^n) / eta   and   h (A - nu P z^n) / eta,
//     A = 1 - delta_A e,   nu = 1 + delta_nu e,   eta = 1 + delta_eta e,
//     h = 1 - zeta1 exp(-((z - q z_u) / zeta2)^2),   z_u = (A / (nu P))^(1/n),
//     zeta1 = zeta_s (1 - exp(-p e)),   zeta2 = (psi + delta_psi e) (lambda + zeta1).
//
// A does not fall below 0.1. These equations have no closed form: z and e follow from steps of
// third order, short against zeta2, which use dz/ds at the start and near the end, and d2z/ds2 at
// the start. Both derivatives at the end are those of the start of the next step, and dz/ds is the
// tangent.
#ifndef JOSTLE_WEN_H
#define JOSTLE_WEN_H

#include <math.h>

#include "jostle/storey_law.h"

enum wen_constant {
    WEN_BACK,
    WEN_STRENGTH,
    WEN_PER_DRIFT,  // 1 / d_y
    WEN_SLOPE,      // slope of the yielding part at z = 0
    WEN_EXPONENT,
    WEN_PLUS,   // gamma + beta
    WEN_MINUS,  // gamma - beta
    WEN_ROOT_OF_PLUS,
    WEN_ROOT_OF_MINUS,  // root of -MINUS
    WEN_DEGRADES,       // 1: by one of the values below
    WEN_YIELDING,       // 1 - R
    WEN_WEAR            // enum wen_wear
};

enum wen_wear {
    WEN_DELTA_A,
    WEN_DELTA_NU,
    WEN_DELTA_ETA,
    WEN_ZETA_S,
    WEN_Q,
    WEN_P,
    WEN_PSI,
    WEN_DELTA_PSI,
    WEN_LAMBDA,
    WEN_WEARS
};

enum { WEN_CONSTANTS = WEN_WEAR + WEN_WEARS };

enum wen_history {
    WEN_DRIFT,
    WEN_Z,
    WEN_ENERGY,     // e; this and what follows is 0 where nothing degrades
    WEN_LOST,       // 1 - exp(-p e)
    WEN_RATE,       // dz/ds in the direction of the last step
    WEN_BEND,       // d2z/ds2
    WEN_DIRECTION,  // of the last step: 1, -1, or 0 at the start
    WEN_HISTORY
};

static const double WEN_STEP = 0.02;  // longest step of an integration, in units of d_y

// dz/ds along the drift s in units of d_y; z counts positive in the direction of the drift.
static inline double wen_slope(const double *c, double z) {
    const double n = c[WEN_EXPONENT];
    const double power = n == 2.0 ? z * z : n == 1.0 ? fabs(z) : pow(fabs(z), n);
    return 1.0 - power * (z > 0.0 ? c[WEN_PLUS] : c[WEN_MINUS]);
}

// respond and stored of a storey that degrades.
struct storey_response wen_worn_respond(const double *constant, const double *history, double drift,
                                        double *after);
double wen_worn_stored(const double *constant, const double *history, double drift);

#endif
