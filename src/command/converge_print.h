// SPDX-License-Identifier: GPL-3.0-or-later
// The results of `converge` as a table to read, or one to read by programs.
#ifndef JOSTLE_CONVERGE_PRINT_H
#define JOSTLE_CONVERGE_PRINT_H

#include "study/refinement.h"

// The last levels with orders and error bars, then what has not converged to `rtol` and why.
void converge_print(const struct model *m, const struct refinement *r, double rtol);

// owner, name, quantity, unit, the result of each level, order, estimate, error, converged, reason.
void converge_print_tsv(const struct model *m, const struct refinement *r);

#endif
