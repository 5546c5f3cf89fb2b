// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary effects (Morris 1991, Technometrics 33, 161-174). Parameters take `n_level` levels of
// equal distance, as numbers u between 0 and 1. A trajectory has a run at a random point of this
// grid, and then one more for each parameter in random order, which jumps up or down by n_level / 2
// levels. The effect of the jump is the change of the demand over that of u. Reported are
//     mu:     mean of the effects
//     mu*:    mean of their absolute values (Campolongo, Cariboni & Saltelli 2007, Environ. Model.
//             Softw. 22, 1509-1518)
//     sigma:  their standard deviation; 0 for a parameter that acts alone and linearly
#ifndef JOSTLE_MORRIS_H
#define JOSTLE_MORRIS_H

#include "study/sobol.h"

struct morris_design {
    int n_parameter, n_level;  // n_level is even
    size_t n;                  // trajectories, of n_parameter + 1 runs each
    unsigned char *level;      // (n, n_parameter + 1, n_parameter)
};

// Draws the levels; the same design always gives the same ones. Errors: STATUS_SYSTEM (no memory).
int morris_draw(const struct morris_design *d, struct error *e);

struct morris_effect {
    struct sobol_index mu_star;
    double mu, sigma;
};

// Fills `effect` (n_parameter) from the demands (n, n_parameter + 1); `step` is the u between two
// levels. A trajectory with a demand that is not finite is left out. Errors: STATUS_FAILED (fewer
// than two trajectories), STATUS_SYSTEM (no memory).
int morris_find(const struct morris_design *d, const double *demand, double step,
                struct morris_effect *effect, size_t *n_left_out, struct error *e);

#endif
