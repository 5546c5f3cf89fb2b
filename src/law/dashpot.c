// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/dashpot.h"

#include <math.h>

#include "law/restitution.h"

const struct row dashpot_rows[DASHPOT_ROWS] = {
    [DASHPOT_K] = {"k", ROW_NUMBER, ROW_REQUIRED, OF_STIFFNESS, &range_positive, NAN,
                   "impact stiffness"},
    [DASHPOT_E] = RESTITUTION_ROW,
    [DASHPOT_ZETA] = {"zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,
                      "damping ratio"},
};

void dashpot_prepare(const double *value, double m_eff, double (*relation)(double e),
                     double *constant) {
    double zeta = restitution_ratio(value[DASHPOT_E], value[DASHPOT_ZETA], relation);
    constant[DASHPOT_STIFFNESS] = value[DASHPOT_K];
    constant[DASHPOT_COEFFICIENT] = 2.0 * zeta * sqrt(value[DASHPOT_K] * m_eff);
}
