// SPDX-License-Identifier: GPL-3.0-or-later
// Kelvin-Voigt without tension: F = max(0, k d + c v), c = 2 zeta sqrt(k m).
//
// The bodies separate when the force reaches zero, while d is still positive. The spring then
// relaxes without force. The law dissipates less energy than kelvin-voigt: with the published zeta
// an e of 0.65 gives 0.6748. The force jumps at closure. Its slope jumps where the force reaches
// zero.
#include "law/lists.h"
#include "law/restitution.h"

static double with_tension(const double *c, double d, double v) {
    return c[DASHPOT_STIFFNESS] * d + c[DASHPOT_COEFFICIENT] * v;
}

static struct contact_response komodromos_force(const double *c, const double *h, double d,
                                                double v) {
    (void)h;
    double force = with_tension(c, d, v);
    if (force <= 0.0) {
        return (struct contact_response){0};
    }
    return (struct contact_response){
        .force = force, .dfdd = c[DASHPOT_STIFFNESS], .dfdv = c[DASHPOT_COEFFICIENT]};
}

// The force becomes zero or begins here.
static double komodromos_kink(const double *c, const double *h, const struct contact_way *way) {
    (void)h;
    double force = with_tension(c, way->d, way->v);
    return with_tension(c, way->d0, way->v0) > 0.0 ? force : -force;
}

const struct contact_law contact_komodromos = {
    .name = "komodromos",
    .summary = "linear spring and dashpot without tension",
    .formula = "F = max(0, k d + c v), c = 2 zeta sqrt(k m*), zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    .source =
        "Komodromos, Polycarpou, Papaloizou & Phocas (2007), Earthquake Eng. Struct. Dyn. 36, "
        "1605-1622",
    .remarks = "Use it for flat faces. It delivers more than e: 0.675 for 0.65.",
    .example = "-k 93.5MN/m -e 0.65",
    .row = restitution_dashpot_rows,
    .n_row = DASHPOT_ROWS,
    .n_constant = DASHPOT_CONSTANTS,
    .traits = CONTACT_JUMPS | CONTACT_NEEDS_MASS,
    .prepare = restitution_prepare,
    .force = komodromos_force,
    .kink = komodromos_kink,
    .exact = restitution_no_tension,
};
