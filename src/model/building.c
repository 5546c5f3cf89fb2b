// SPDX-License-Identifier: GPL-3.0-or-later
// What the damping matrix of a building does.
#include "jostle/model.h"

#include <math.h>
#include <stdlib.h>

void building_damping_force(const struct building *g, const double *v, double *force) {
    int n = g->n_floor;
    if (g->damping_full) {
        for (int i = 0; i < n; i++) {
            const double *row = g->damping_full + (size_t)i * (size_t)n;
            double sum = 0.0;
            for (int j = 0; j < n; j++) {
                sum += row[j] * v[j];
            }
            force[i] = sum;
        }
        return;
    }
    const double *diagonal = g->damping_diagonal;
    const double *off = g->damping_off;
    double below = 0.0;
    for (int i = 0; i < n; i++) {
        double above = i + 1 < n ? off[i] * v[i + 1] : 0.0;
        force[i] = below + diagonal[i] * v[i] + above;
        below = off[i] * v[i];
    }
}

int building_damping_ratio(const struct building *g, int mode, double *ratio, struct error *e) {
    size_t n = (size_t)g->n_floor;
    const double *phi = g->shape + (size_t)(mode - 1) * n;
    double *force = calloc(n, sizeof *force);
    if (!force) {
        return error_no_memory(e);
    }
    building_damping_force(g, phi, force);
    double damping = 0.0;
    double mass = 0.0;
    for (size_t i = 0; i < n; i++) {
        damping += phi[i] * force[i];
        mass += phi[i] * g->mass[i] * phi[i];
    }
    free(force);
    double critical = 2.0 * g->omega[mode - 1] * mass;
    *ratio = critical > 0.0 ? damping / critical : NAN;
    return STATUS_OK;
}
