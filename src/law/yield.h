// SPDX-License-Identifier: GPL-3.0-or-later
// Rows that all yielding storeys have.
#ifndef JOSTLE_YIELD_H
#define JOSTLE_YIELD_H

#include "jostle/row.h"
#include "jostle/storey_law.h"

extern const struct range yield_hardening_range;  // >= 0 and < 1
extern const struct range yield_falling_range;    // >= -1 and < 1

#define YIELD_ROW                                                                                  \
    {                                                                                              \
        "yield", ROW_LIST, ROW_REQUIRED, OF_FORCE, &range_positive, NAN,                           \
            "storey shear at first yield"                                                          \
    }

#define HARDENING_ROW                                                                              \
    {                                                                                              \
        "hardening", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &yield_hardening_range, NAN,               \
            "ratio of the stiffness after yield to the initial stiffness"                          \
    }

// Of laws whose strength may fall after yield, if the user gives a negative number.
#define FALLING_ROW                                                                                \
    {                                                                                              \
        "hardening", ROW_NUMBER, ROW_REQUIRED, OF_NONE, &yield_falling_range, NAN,                 \
            "ratio of the stiffness after yield to the initial stiffness"                          \
    }

#define YIELD_NEGATIVE_ROW                                                                         \
    {                                                                                              \
        "yield-negative", ROW_LIST, 0, OF_FORCE, &range_positive, NAN,                             \
            "storey shear at first yield of negative drifts (default: -yield)"                     \
    }

// The drift and the shear at yield, the same in both directions.
static inline void yield_describe(double drift, double shear, struct storey_figures *out) {
    out->yield[0] = out->yield[1] = drift;
    out->strength[0] = out->strength[1] = shear;
}

// Computes the constants of a storey law, and refuses one that yields on a stiffness of 0.
int storey_law_prepare(const struct storey_law *law, const double *value, double stiffness,
                       double *constant, struct error *e);

#endif
