// SPDX-License-Identifier: GPL-3.0-or-later
// The usual law of `link`: a spring and a viscous damper that act in both directions.
#ifndef JOSTLE_BILATERAL_H
#define JOSTLE_BILATERAL_H

#include "jostle/contact_law.h"

// Its rows; the first are also its first constants.
enum bilateral_row {
    BILATERAL_STIFFNESS,
    BILATERAL_DASHPOT,
    BILATERAL_EXPONENT,
    BILATERAL_RELIEF,
    BILATERAL_RELIEF_DASHPOT,
    BILATERAL_ROWS
};

extern const struct range bilateral_exponent;  // > 0 and <= 3

// Is the force k d + c v?
bool bilateral_is_linear(const struct contact_law *law, const double *constant);

// Has it an infinite slope at v = 0?
bool bilateral_is_steep(const struct contact_law *law, const double *constant);

extern const struct row bilateral_rows[BILATERAL_ROWS];

// The law is not in the table of contact laws, because it has no contact condition.
extern const struct contact_law bilateral_law;

#endif
