// SPDX-License-Identifier: GPL-3.0-or-later
// Kelvin-Voigt: linear spring and dashpot, F = k d + c v, c = 2 zeta sqrt(k m).
//
// The tension just before separation is kept, so that an isolated impact delivers exactly the e
// that zeta was made from. The force jumps from 0 to c v0 at closure, and from its tension to 0 at
// opening.
#include <math.h>

#include "law/contact_list.h"
#include "law/restitution.h"

enum { K, E, ZETA, N_ROW };
enum { STIFFNESS, DASHPOT, N_CONSTANT };

static const struct row rows[N_ROW] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, {1, -1, 0}, &range_positive, NAN, "impact stiffness"},
    [E] = {"e", ROW_NUMBER, ROW_ONE_OF, {0}, &restitution_range, NAN, "coefficient of restitution"},
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, {0}, &range_non_negative, NAN, "damping ratio"},
};

static int kelvin_voigt_prepare(const double *value, double m_eff, double *constant,
                                struct error *e) {
    (void)e;
    double zeta = restitution_ratio(value[E], value[ZETA], restitution_kelvin_voigt);
    constant[STIFFNESS] = value[K];
    constant[DASHPOT] = 2.0 * zeta * sqrt(value[K] * m_eff);
    return STATUS_OK;
}

static struct contact_response kelvin_voigt_force(const double *c, const double *h, double d,
                                                  double v) {
    (void)h;
    return (struct contact_response){
        .force = c[STIFFNESS] * d + c[DASHPOT] * v,
        .dfdd = c[STIFFNESS],
        .dfdv = c[DASHPOT],
    };
}

const struct contact_law contact_kelvin_voigt = {
    .name = "kelvin-voigt",
    .summary = "linear spring and dashpot, tension kept",
    .formula = "F = k d + c v, c = 2 zeta sqrt(k m*), zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    .source = "Anagnostopoulos (1988), Earthquake Eng. Struct. Dyn. 16, 443-456, eq. 3-4; sign of "
              "zeta as derived there, missing in several later papers",
    .remarks = "for comparison with the literature; delivers e exactly in an isolated impact, "
               "whatever v0; jumps at closure and pulls before separation",
    .example = "-k 93.5MN/m -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .traits = CONTACT_JUMPS | CONTACT_MAY_PULL | CONTACT_NEEDS_MASS,
    .prepare = kelvin_voigt_prepare,
    .force = kelvin_voigt_force,
    .exact = restitution_kelvin_voigt,
};
