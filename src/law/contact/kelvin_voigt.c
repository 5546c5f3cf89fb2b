// SPDX-License-Identifier: GPL-3.0-or-later
// Kelvin-Voigt: linear spring and dashpot, F = k d + c v, c = 2 zeta sqrt(k m).
//
// The contact keeps its tension just before separation. So an isolated impact delivers exactly the
// e from which zeta was computed. The force jumps from 0 to c v0 at closure, and from tension to 0
// at opening.
#include "law/in_lanes.h"
#include "law/lists.h"
#include "law/restitution.h"

LANES_INLINE struct contact_response kelvin_voigt_force(const double *c, const double *h, double d,
                                                        double v) {
    (void)h;
    return (struct contact_response){
        .force = c[DASHPOT_STIFFNESS] * d + c[DASHPOT_COEFFICIENT] * v,
        .dfdd = c[DASHPOT_STIFFNESS],
        .dfdv = c[DASHPOT_COEFFICIENT],
    };
}

LANES static void kelvin_voigt_lanes(const double *constant, const double *d, const double *v,
                                     struct contact_lanes *r) {
    in_lanes(kelvin_voigt_force, DASHPOT_CONSTANTS, constant, d, v, r);
}

const struct contact_law contact_kelvin_voigt = {
    .name = "kelvin-voigt",
    .summary = "linear spring and dashpot, with tension",
    .formula = "F = k d + c v, c = 2 zeta sqrt(k m*), zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    .source = "Anagnostopoulos (1988), Earthquake Eng. Struct. Dyn. 16, 443-456, eq. 3-4, with the "
              "minus sign of zeta, which several later papers omit",
    .remarks = "Use it to compare with the literature. It delivers e exactly in an isolated "
               "impact, at any velocity. It pulls before the bodies part.",
    .example = "-k 93.5MN/m -e 0.65",
    .row = restitution_dashpot_rows,
    .n_row = DASHPOT_ROWS,
    .n_constant = DASHPOT_CONSTANTS,
    .traits = CONTACT_JUMPS | CONTACT_MAY_PULL | CONTACT_NEEDS_MASS | CONTACT_SMOOTH,
    .prepare = restitution_prepare,
    .force = kelvin_voigt_force,
    .force_lanes = kelvin_voigt_lanes,
    .exact = restitution_kelvin_voigt,
};
