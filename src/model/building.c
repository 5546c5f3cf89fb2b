// SPDX-License-Identifier: GPL-3.0-or-later
// The damping forces of a building.
#include "jostle/model.h"

#include <assert.h>
#include <math.h>

#include "core/lanes.h"
#include "model/tangent_damping.h"

void building_damping_force(const struct building *g, const double *v, double *force) {
    const int n = g->n_dof;
    if (g->damping_full) {
        lanes_add_symmetric(n, g->damping_full, v, NULL, force);
        return;
    }
    for (int i = 0; i < n; i++) {
        double below = i > 0 ? g->damping_off[i - 1] * v[i - 1] : 0.0;
        double above = i + 1 < n ? g->damping_off[i] * v[i + 1] : 0.0;
        force[i] = below + g->damping_diagonal[i] * v[i] + above;
    }
}

// phi' C phi of damping on the tangent stiffness, which is the initial one here.
static double tangent_term(const struct tangent_damping *t, const double *phi) {
    double sum = 0.0;
    for (int i = 0; t && i < t->n; i++) {
        for (int j = 0; j < t->n; j++) {
            const int k = i * t->n + j;
            const double drift_i = phi[i] - (i > 0 ? phi[i - 1] : 0.0);
            const double drift_j = phi[j] - (j > 0 ? phi[j - 1] : 0.0);
            sum += drift_i * t->beta[k] * t->initial[k] * drift_j;
        }
    }
    return sum;
}

double building_damping_ratio(const struct building *g, int mode) {
    assert(mode >= 1 && mode <= g->n_dof && g->n_dof <= FLOORS_MAX);
    int n = g->n_dof;
    const double *phi = g->shape + (size_t)(mode - 1) * (size_t)n;
    double force[FLOORS_MAX];
    double damping = tangent_term(g->tangent, phi);
    double mass = 0.0;
    building_damping_force(g, phi, force);
    for (int i = 0; i < n; i++) {
        damping += phi[i] * force[i];
        mass += phi[i] * g->mass[i] * phi[i];
    }
    double critical = 2.0 * g->omega[mode - 1] * mass;
    return critical > 0.0 ? damping / critical : NAN;
}
