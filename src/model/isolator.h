// SPDX-License-Identifier: GPL-3.0-or-later
// Isolators: bearings as the law of a storey.
#ifndef JOSTLE_ISOLATOR_H
#define JOSTLE_ISOLATOR_H

#include "model/builder.h"

// A bearing of a statement. NAN: not given.
struct isolator_draft {
    int building, storey;  // storey: from 0
    struct word word;      // its kind, for messages
    bool slides;           // else it is of lead and rubber

    double radius, mu, mu_slow, rate, weight;  // [L], numbers, [T/L], [F] of one that slides
    double yield_drift;                        // [L]
    double q, kd, ki;                          // [F] [F/L] [F/L] of one of lead and rubber
};

// Gives the storeys their laws. The weight of a bearing, unless it is given, is that of the floors
// above, or of P-delta where the building has it.
void isolator_finish(struct builder *b);

#endif
