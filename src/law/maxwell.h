// SPDX-License-Identifier: GPL-3.0-or-later
// Maxwell's law of links: a spring and a viscous damper in series.
#ifndef JOSTLE_MAXWELL_H
#define JOSTLE_MAXWELL_H

#include "jostle/contact_law.h"

enum maxwell_row { MAXWELL_STIFFNESS, MAXWELL_DASHPOT, MAXWELL_EXPONENT, MAXWELL_ROWS };
extern const struct row maxwell_rows[MAXWELL_ROWS];

// Values of its history. The step is 0 but for the force at the end of a step of that length.
enum maxwell_history {
    MAXWELL_STEP,   // [T] of CONTACT_NEEDS_STEP
    MAXWELL_CREEP,  // [L] shortening of the damper
    MAXWELL_RATE,   // [L/T] of that
    MAXWELL_HISTORY
};

extern const struct contact_law maxwell_law;

#endif
