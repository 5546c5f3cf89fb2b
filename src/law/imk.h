// SPDX-License-Identifier: GPL-3.0-or-later
// Rules of the storey of Ibarra, Medina & Krawinkler (2005), Earthquake Eng. Struct. Dyn. 34,
// 1489-1511. One direction, drift d and shear V positive:
//
//     backbone  max(min(Fy + Ks (d - Fy / k), Fref + a k d), residual); nothing beyond `ultimate`.
//     bilinear  min(Fy + Ks (d - Fy / k), max(Fref + a k d, residual), limit), where the limit is
//               the least shear reached so far beyond capping.
//
// An excursion is the path between two instants of zero shear, with the work E. Let S be the sum of
// E of finished excursions. Then beta = (E / (gamma Vy dy - S - E))^c for each mode. At zero shear
// the direction that is entered changes, with its share D:
//
//     Fy, Ks *= 1 - D beta_s,   Fref *= 1 - D beta_c,   target dt *= 1 + D beta_a.
//
// At a turn the unloading stiffness becomes K0 (1 - beta_k), where K0 is that of the start of the
// excursion and E is without the part that unloading gives back. The least value is the secant of
// both targets, or 0.1 k for bilinear. Reloading is never steeper than unloading. It goes
//
//     bilinear  along K up to the backbone;
//     peak      to the last turn of that direction if this path is stiffer, then to the target, the
//               largest drift reached so far, on the backbone;
//     pinched   to the drift (1 - kd) of the permanent drift of the target, on the line from the
//               start to kf of the target's shear, then to the target.
//
// If E is at least what is left of a capacity, the storey has no strength from the next zero shear
// on, or beta is 1.
//
// The paper itself was not at hand. The rules follow programs of the authors' group and OpenSees.
// Where these disagree, options select the rule.
#ifndef JOSTLE_IMK_H
#define JOSTLE_IMK_H

#include "law/loading.h"

enum imk_cycle { IMK_BILINEAR, IMK_PEAK, IMK_PINCHED };

enum imk_mode { IMK_STRENGTH, IMK_CAPPING, IMK_TARGET, IMK_UNLOADING, IMK_MODES };

// Of one direction.
enum imk_side {
    IMK_YIELD,      // V_y
    IMK_HARDENING,  // slope after yield
    IMK_REFERENCE,  // shear of the line beyond capping at d = 0; infinite: there is none
    IMK_FALL,       // its slope
    IMK_RESIDUAL,   // shear
    IMK_ULTIMATE,   // drift
    IMK_SHARE,      // D
    IMK_SIDE
};

enum imk_constant {
    IMK_RIGHT = LOADING_CONSTANTS,
    IMK_LEFT = IMK_RIGHT + IMK_SIDE,
    IMK_CAPACITY = IMK_LEFT + IMK_SIDE,  // gamma V_y d_y of each mode
    IMK_EXPONENT = IMK_CAPACITY + IMK_MODES,
    IMK_CYCLE = IMK_EXPONENT + IMK_MODES,
    IMK_KF,
    IMK_KD,
    IMK_LOCAL,      // reloading aims at the last turn first
    IMK_EARLIER,    // S is without E
    IMK_COMPOUND,   // the unloading stiffness falls at each turn
    IMK_UNLIMITED,  // bilinear without limit
    IMK_KEEPS,      // beta is 1 when a capacity is used up
    IMK_BOTH,       // `ultimate` ends both directions
    IMK_NOISE,      // rounding of E
    IMK_CONSTANTS
};

// What changes, of one direction.
enum imk_own {
    IMK_FY,
    IMK_KS,
    IMK_FREF,
    IMK_DT,           // target
    IMK_LOCAL_DRIFT,  // last turn below the target
    IMK_LOCAL_SHEAR,  // 0: there is none
    IMK_LIMIT,
    IMK_DEAD,  // 1: no strength
    IMK_OWN
};

enum imk_history {
    IMK_OF_RIGHT = LOADING_OWN,
    IMK_OF_LEFT = IMK_OF_RIGHT + IMK_OWN,
    IMK_START_SLOPE = IMK_OF_LEFT + IMK_OWN,  // K0
    IMK_SUM,                                  // S
    IMK_LOST,                                 // 1: a capacity is used up
    IMK_PATH,
    IMK_HISTORY = IMK_PATH + LOADING_PATH_SIZE
};

extern const struct loading_rule imk_rule;

#endif
