// SPDX-License-Identifier: GPL-3.0-or-later
// Linear spring with a dashpot during approach: F = k d + c v while v > 0, F = k d afterwards, with
// c = 2 zeta sqrt(k m).
//
// With the relation of 2011, zeta = (1 - e^2) / (e (e (pi - 2) + 2)), an e of 0.65 gives 0.6538.
// With the relation of 2008, (1 - e^2) / (pi e), it gives 0.6848. The force jumps from 0 to c v0 at
// closure. Its slope jumps at v = 0. A renewed approach within one contact is damped again.
#include <gsl/gsl_math.h>
#include <math.h>

#include "law/lists.h"
#include "law/restitution.h"

// The rows of law/restitution.h, and RELATION.
enum { K = DASHPOT_K, E = DASHPOT_E, ZETA = DASHPOT_ZETA, RELATION = DASHPOT_ROWS, N_ROW };

static const struct range relation_range = {.min = 2008, .max = 2011, .text = "2008 or 2011"};

static const struct row rows[N_ROW] = {
    [K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN, "impact stiffness"},
    [E] = RESTITUTION_ROW,
    [ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN, "damping ratio"},
    [RELATION] = {"relation", ROW_INTEGER, 0, OF_NONE, &relation_range, NAN,
                  "year of the relation zeta(e); default: 2011"},
};

static double relation_2011(double e) {
    return (1.0 - e * e) / (e * (e * (M_PI - 2.0) + 2.0));
}

static double relation_2008(double e) {
    return (1.0 - e * e) / (M_PI * e);
}

static int mahmoud_jankowski_prepare(const double *value, double m_eff, double *constant,
                                     struct error *e) {
    double year = isnan(value[RELATION]) ? 2011.0 : value[RELATION];
    if (year != 2008.0 && year != 2011.0) {
        return error_set(e, STATUS_INPUT, "relation is %g; it must be 2008 or 2011", year);
    }
    if (isnan(value[E]) && !isnan(value[RELATION])) {
        return error_set(e, STATUS_INPUT,
                         "-relation has no effect where -zeta or -calibrate sets the damping");
    }
    restitution_dashpot(value, m_eff, year == 2008.0 ? relation_2008 : relation_2011, constant);
    return STATUS_OK;
}

static struct contact_response mahmoud_jankowski_force(const double *c, const double *h, double d,
                                                       double v) {
    (void)h;
    struct contact_response r = {.force = c[DASHPOT_STIFFNESS] * d, .dfdd = c[DASHPOT_STIFFNESS]};
    if (v > 0.0) {
        r.force += c[DASHPOT_COEFFICIENT] * v;
        r.dfdv = c[DASHPOT_COEFFICIENT];
    }
    return r;
}

const struct contact_law contact_mahmoud_jankowski = {
    .name = "mahmoud-jankowski",
    .summary = "linear spring with a dashpot during approach",
    .formula = "F = k d + c v while v > 0, k d after; c = 2 zeta sqrt(k m*), "
               "zeta = (1 - e^2) / (e (e (pi - 2) + 2))",
    .source = "Mahmoud & Jankowski (2011), Iranian J. Sci. Technol., Trans. Civil Eng. 35, 51-62; "
              "-relation 2008: Mahmoud, Chen & Jankowski (2008), J. Appl. Sci. 8, 1850-1858",
    .remarks = "Use it for flat faces. It delivers nearly e if e is above 0.4.",
    .example = "-k 93.5MN/m -e 0.65",
    .row = rows,
    .n_row = N_ROW,
    .n_constant = DASHPOT_CONSTANTS,
    .traits = CONTACT_JUMPS | CONTACT_NEEDS_MASS | CONTACT_SMOOTH,
    .prepare = mahmoud_jankowski_prepare,
    .force = mahmoud_jankowski_force,
    .exact = restitution_approach,
};
