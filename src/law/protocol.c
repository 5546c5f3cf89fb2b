// SPDX-License-Identifier: GPL-3.0-or-later
#include "law/protocol.h"

#include <assert.h>

// FEMA 461 (2007), Interim testing protocols: two cycles of each amplitude, which
// rises by 1.4. SAC/BD-97/02 (Clark, Frank, Krawinkler & Shaw 1997), as in AISC 341, section K2:
// storey drift angles of 0.375, 0.5, 0.75, 1, 1.5, 2, 3 and 4 %.
const struct protocol protocols[] = {
    {"fema461",
     "FEMA 461 (2007), Interim testing protocols",
     10,
     {0.048, 0.068, 0.095, 0.133, 0.186, 0.26, 0.364, 0.51, 0.714, 1.0},
     {2, 2, 2, 2, 2, 2, 2, 2, 2, 2}},
    {"sac",
     "SAC/BD-97/02 (1997), as in AISC 341, section K2",
     8,
     {0.09375, 0.125, 0.1875, 0.25, 0.375, 0.5, 0.75, 1.0},
     {6, 6, 6, 4, 2, 2, 2, 2}},
};
const int n_protocol = sizeof protocols / sizeof protocols[0];

int protocol_targets(const struct protocol *p, double amplitude,
                     double target[PROTOCOL_TARGETS_MAX]) {
    int n = 0;
    for (int i = 0; i < p->n; i++) {
        for (int k = 0; k < p->cycles[i]; k++) {
            assert(n + 3 <= PROTOCOL_TARGETS_MAX);
            target[n++] = p->amplitude[i] * amplitude;
            target[n++] = -p->amplitude[i] * amplitude;
        }
    }
    target[n++] = 0.0;
    return n;
}
