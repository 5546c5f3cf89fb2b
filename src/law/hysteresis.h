// SPDX-License-Identifier: GPL-3.0-or-later
// The family F = k d^n (1 + q v / v0), shared by the laws that differ only in their relation q(e).
// The force starts and ends at zero, but is negative where the bodies part faster than v0 / q,
// which happens only when other forces pull them. A velocity at closure below `vmin` counts as
// vmin: else the dashpot of a gentle touch would grow without bound and glue the bodies together.
#ifndef JOSTLE_HYSTERESIS_H
#define JOSTLE_HYSTERESIS_H

#include "jostle/contact_law.h"

// Rows of the laws with any exponent, and the values that hysteresis_prepare takes.
enum hysteresis_row {
    HYSTERESIS_K,
    HYSTERESIS_E,
    HYSTERESIS_ZETA,
    HYSTERESIS_VMIN,
    HYSTERESIS_N,
    HYSTERESIS_ROWS
};
extern const struct row hysteresis_rows[HYSTERESIS_ROWS];

#define HYSTERESIS_ZETA_ROW                                                                        \
    {                                                                                              \
        "zeta", ROW_NUMBER, ROW_ONE_OF, OF_NONE, &range_non_negative, NAN,                         \
            "dimensionless damping q = zeta v0 / k"                                                \
    }

#define HYSTERESIS_VMIN_ROW                                                                        \
    {                                                                                              \
        "vmin", ROW_NUMBER, 0, OF_VELOCITY, &range_positive, 1e-3,                                 \
            "velocity at closure below which v0 counts as this"                                    \
    }

enum { HYSTERESIS_CONSTANTS = 4, HYSTERESIS_HISTORY = 1 };

// Constants from the values of the rows above; q is the value of zeta, or relation(e), which gives
// NAN where there is no memory. Errors: STATUS_SYSTEM.
int hysteresis_prepare(const double *value, double (*relation)(double e), double *constant,
                       struct error *e);

// close and force of the descriptors.
void hysteresis_close(const double *constant, double v0, double *history);
struct contact_response hysteresis_force(const double *constant, const double *history, double d,
                                         double v);

#endif
