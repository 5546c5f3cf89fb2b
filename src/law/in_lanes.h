// SPDX-License-Identifier: GPL-3.0-or-later
// The force of a law for several links in lanes. The compiler vectorises the function of one link,
// which has no branches.
#ifndef JOSTLE_IN_LANES_H
#define JOSTLE_IN_LANES_H

#include "core/lanes.h"
#include "jostle/contact_law.h"

// `n`: number of constants, a literal at compile time.
LANES_INLINE void in_lanes(struct contact_response (*force)(const double *, const double *, double,
                                                            double),
                           int n, const double *restrict constant, const double *restrict d,
                           const double *restrict v, struct contact_lanes *restrict r) {
    LANES_LOOP
    for (int i = 0; i < CONTACT_LANES; i++) {
        double own[CONTACT_CONSTANTS_MAX];
        for (int j = 0; j < n; j++) {
            own[j] = constant[j * CONTACT_LANES + i];
        }
        const struct contact_response one = force(own, NULL, d[i], v[i]);
        r->force[i] = one.force;
        r->dfdd[i] = one.dfdd;
        r->dfdv[i] = one.dfdv;
    }
}

#endif
