// SPDX-License-Identifier: GPL-3.0-or-later
// Rows and constants of the laws with a linear spring k and a dashpot c = 2 zeta sqrt(k m). The
// laws differ in the part of the impact in which the dashpot acts, and in the relation zeta(e).
#ifndef JOSTLE_DASHPOT_H
#define JOSTLE_DASHPOT_H

#include "jostle/row.h"

enum dashpot_row { DASHPOT_K, DASHPOT_E, DASHPOT_ZETA, DASHPOT_ROWS };
extern const struct row dashpot_rows[DASHPOT_ROWS];

enum dashpot_constant { DASHPOT_STIFFNESS, DASHPOT_COEFFICIENT, DASHPOT_CONSTANTS };

// Computes k and c from the values of these rows. zeta is the given value or relation(e).
void dashpot_prepare(const double *value, double m_eff, double (*relation)(double e),
                     double *constant);

#endif
