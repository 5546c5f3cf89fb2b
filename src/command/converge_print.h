// SPDX-License-Identifier: GPL-3.0-or-later
// The results of `converge` as a table to read, or one to read by programs.
#ifndef JOSTLE_CONVERGE_PRINT_H
#define JOSTLE_CONVERGE_PRINT_H

#include "command/printer.h"
#include "study/refinement.h"

// In text the last levels with orders and error bars, then what has not converged to `rtol` and
// why; as data owner, name, quantity, unit, the result of each level, order, estimate, error,
// converged, reason. Returns EXIT_DONE or, after a message, the exit status.
int converge_print(const struct model *m, const struct refinement *r, double rtol,
                   enum printer_form form);

#endif
