// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a building on a foundation, with the symbols of foundation.c.
#ifndef JOSTLE_FOUNDED_H
#define JOSTLE_FOUNDED_H

#include "jostle/model.h"

// The part of a building with a foundation. The storeys and parts that yield are kept one by one.
// All that is linear is the stiffness of the part.
struct founded {
    int n;                        // storeys
    const double *share;          // (n) r_i
    const struct storey *storey;  // (n) history: offset in that of the part
    int n_part;
    const struct part *part;  // (n_part) on the deformations of the storeys; history: likewise
};

// d e_i / d d_j.
static inline double founded_entry(const struct founded *f, int i, int j) {
    return (i == j) - f->share[i] - (i == 0 && j <= f->n);
}

// u_b and phi.
struct founded_motion {
    double sway, turn;
};

static inline struct founded_motion founded_motion(const struct founded *f, const double *drift) {
    double sway = 0.0;
    for (int i = 0; i <= f->n; i++) {
        sway += drift[i];
    }
    return (struct founded_motion){sway, sway + drift[f->n + 1]};
}

static inline double founded_deformation(const struct founded *f, int i, const double *drift,
                                         struct founded_motion slab) {
    return drift[i] - f->share[i] * slab.turn - (i == 0 ? slab.sway : 0.0);
}

// The scratch that the part needs, of which its own parts need `inner`.
int founded_n_scratch(int n, int inner);

// Kinds of the part: all its storeys are linear, or some have a history.
extern const struct part_kind founded_linear, founded_yields;

#endif
