// SPDX-License-Identifier: GPL-3.0-or-later
// Jankowski's non-linear viscoelastic law: F = k d^(3/2) + c v while v > 0, F = k d^(3/2)
// afterwards, with c = 2 zeta sqrt(k sqrt(d) m) and the effective mass m.
//
// The published relation is zeta = (9 sqrt5 / 2) (1 - e^2) / (e (e (9 pi - 16) + 16)). One paper
// omits the first e of the denominator. An e of 0.65 gives 0.647. c grows like d^(1/4), so the
// slope of the force is infinite at d = 0. The slope jumps at v = 0. A renewed approach within one
// contact is damped again.
#include <gsl/gsl_math.h>
#include <math.h>

#include "law/in_lanes.h"
#include "law/lists.h"
#include "law/power.h"
#include "law/restitution.h"

enum { K, E, ZETA, N_ROW };
enum { STIFFNESS, DASHPOT, N_CONSTANT };  // DASHPOT: c / d^(1/4)

static const struct row rows[N_ROW] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_HERTZ_STIFFNESS, &range_positive, NAN,
           "impact stiffness"},
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN, "damping ratio"},
};

static double published_zeta(double e) {
    return 4.5 * sqrt(5.0) * (1.0 - e * e) / (e * (e * (9.0 * M_PI - 16.0) + 16.0));
}

static int jankowski_prepare(const double *value, double m_eff, double *constant, struct error *e) {
    (void)e;
    double zeta = restitution_ratio(value[E], value[ZETA], published_zeta);
    constant[STIFFNESS] = value[K];
    constant[DASHPOT] = 2.0 * zeta * sqrt(value[K] * m_eff);
    return STATUS_OK;
}

// Force with the dashpot, for d > 0.
LANES_INLINE struct contact_response damped(const double *c, double d, double v) {
    struct contact_response r = power_spring(c[STIFFNESS], 1.5, d);
    double dashpot = c[DASHPOT] * sqrt(sqrt(d));
    r.force += dashpot * v;
    r.dfdd += dashpot * v / (4.0 * d);
    r.dfdv = dashpot;
    return r;
}

static struct contact_response jankowski_force(const double *c, const double *h, double d,
                                               double v) {
    (void)h;
    return v > 0.0 && d > 0.0 ? damped(c, d, v) : power_spring(c[STIFFNESS], 1.5, d);
}

LANES_INLINE struct contact_response without_branches(const double *c, const double *h, double d,
                                                      double v) {
    (void)h;
    const struct contact_response with = damped(c, d, v);
    const struct contact_response without = power_spring(c[STIFFNESS], 1.5, d);
    const bool damps = (v > 0.0) & (d > 0.0);
    return (struct contact_response){
        .force = damps ? with.force : without.force,
        .dfdd = damps ? with.dfdd : without.dfdd,
        .dfdv = damps ? with.dfdv : 0.0,
    };
}

LANES static void jankowski_lanes(const double *constant, const double *d, const double *v,
                                  struct contact_lanes *r) {
    in_lanes(without_branches, N_CONSTANT, constant, d, v, r);
}

// There is no closed form. e does not depend on k, m or v0.
static double exact_zeta(double e) {
    return calibrate_by_impact(&contact_jankowski, e, published_zeta(e));
}

const struct contact_law contact_jankowski = {
    .name = "jankowski",
    .summary = "Hertz with a dashpot during approach",
    .formula = "F = k d^1.5 + c v while v > 0, k d^1.5 after; c = 2 zeta sqrt(k sqrt(d) m*), "
               "zeta = (9 sqrt5 / 2)(1 - e^2) / (e (e (9 pi - 16) + 16))",
    .source =
        "Jankowski (2005), Earthquake Eng. Struct. Dyn. 34, 595-611; zeta(e): Jankowski (2006), "
        "ibid. 35, 517-524",
    .remarks = "Use it for curved faces. It delivers nearly e if e is above 0.4. The slope of the "
               "force is infinite at closure, so use half of the step that jostle check proposes.",
    .example = "-k 2.75e9N/m^1.5 -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = N_CONSTANT,
    .traits = CONTACT_NEEDS_MASS | CONTACT_SMOOTH,
    .prepare = jankowski_prepare,
    .force = jankowski_force,
    .force_lanes = jankowski_lanes,
    .exact = exact_zeta,
};
