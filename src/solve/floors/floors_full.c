// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/floors/floors_full.h"

#include "core/lanes.h"

// y = A x, both in whole lanes, for a matrix (stride, stride) of a building.
LANES_INLINE void floors_full_multiply(const struct effective *e, const double *matrix,
                                       const double *x, double *y) {
    const int n = e->building->n_floor, stride = e->stride;
    for (int j = 0; j < stride; j += LANES_WIDTH) {
        lanes_wide sum = {0.0};
        for (int i = 0; i < n; i++) {
            sum += x[i] * LANES_AT(matrix + (ptrdiff_t)i * stride, j);
        }
        *(lanes_wide *)(y + j) = sum;
    }
}

LANES void floors_full_high(const struct effective *e, const double *u, const double *v,
                            double *residual) {
    const int n = e->building->n_floor;
    double force[FLOORS_MAX + LANES_WIDTH], drift[FLOORS_MAX];
    floors_full_multiply(e, e->damping, v, force);
    for (int i = 0; i < n; i++) {
        residual[i] -= force[i];
    }
    if (e->parts) {
        for (int i = 0; i < n; i++) {
            drift[i] = u[i] - (i > 0 ? u[i - 1] : 0.0);
        }
        floors_full_multiply(e, e->parts, drift, force);
        for (int i = 0; i < n; i++) {
            residual[i] += (i + 1 < n ? force[i + 1] : 0.0) - force[i];
        }
    }
}

// Adds twice the work of C in the step from `now` to `next` to `work`.
LANES static void floors_full_damp(const struct effective *e, const struct state *now,
                                   const struct state *next, double *work) {
    const int n = e->building->n_floor, first = e->building->first;
    const double *u0 = now->u + first, *u1 = next->u + first;
    const double *v0 = now->v + first, *v1 = next->v + first;
    lanes_wide sum = LANES_AT(work, 0);
    for (int j = 0; j < n; j += LANES_WIDTH) {
        const double *row = e->damping + j;
        lanes_wide force_2x = {0.0};
        for (int i = 0; i < n; i++, row += e->stride) {
            force_2x += (v0[i] + v1[i]) * LANES_AT(row, 0);
        }
        sum += force_2x * (LANES_AT(u1, j) - LANES_AT(u0, j));
    }
    *(lanes_wide *)work = sum;
}

void floors_full_work(const struct work *w, const struct state *now, const struct state *next) {
    for (int k = 0; w->model->chain.full_damping && k < w->model->n_building; k++) {
        if (w->effective[k].damping) {
            floors_full_damp(&w->effective[k], now, next, w->floors.account.energy->damping_2x);
        }
    }
}

// Adds the shears of the parts at the drifts of `s` to its shears.
LANES static void floors_full_shears(const struct effective *e, struct state *s) {
    const int n = e->building->n_floor, first = e->building->first;
    const double *drift = s->drift + first;
    double *shear = s->shear + first;
    for (int j = 0; j < n; j += LANES_WIDTH) {
        const double *row = e->parts + j;
        lanes_wide sum = LANES_AT(shear, j);
        for (int i = 0; i < n; i++, row += e->stride) {
            sum += drift[i] * LANES_AT(row, 0);
        }
        *(lanes_wide *)(shear + j) = sum;
    }
}

void floors_full_strain(const struct work *w, struct state *s) {
    for (int k = 0; w->model->chain.parts && k < w->model->n_building; k++) {
        if (w->effective[k].parts) {
            floors_full_shears(&w->effective[k], s);
        }
    }
}
