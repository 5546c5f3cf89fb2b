// SPDX-License-Identifier: GPL-3.0-or-later
// Rayleigh: C = a0 M + a1 K, K the initial stiffness, with ratios zeta_i = a0 / (2 w_i) + a1 w_i /
// 2 at two modes; a building of one storey is stiffness-proportional, a1 = 2 zeta / w. Modal: C = M
// Phi diag(2 zeta w) Phi^T M, a full matrix (Chopra, Dynamics of Structures, section 11.4).
#include "model/damping.h"

// a0 and a1 from ratios at two modes; false after a report.
static bool rayleigh(struct builder *b, const struct building_draft *d, const double *omega,
                     double *a0, double *a1) {
    const struct damping_draft *q = &d->damping;
    double wi = omega[q->mode[0] - 1];
    double wj = omega[q->mode[1] - 1];
    if (wi == 0.0 && d->n_floor == 1) {
        deck_error(b->deck, &q->word, "building %s has stiffness 0: no frequency to fit damping to",
                   d->name);
        return false;
    }
    if (wi == 0.0 || wj == 0.0 || (wi == wj && q->mode[0] != q->mode[1])) {
        deck_error(b->deck, &q->word,
                   "modes %d and %d of building %s have no two frequencies to fit damping to",
                   q->mode[0], q->mode[1], d->name);
        return false;
    }
    if (d->n_floor == 1) {
        *a0 = 0.0;
        *a1 = 2.0 * q->value[0] / wi;
        return true;
    }
    double zi = q->value[0];
    double zj = q->value[1];
    double square = wj * wj - wi * wi;
    *a0 = 2.0 * wi * wj * (zi * wj - zj * wi) / square;
    *a1 = 2.0 * (zj * wj - zi * wi) / square;
    return true;
}

// C = a0 M + K(dashpot), where `dashpot` (n) takes the places of the storey stiffnesses.
static void tridiagonal(const struct building_draft *d, double a0, double a1, const double *dashpot,
                        double *diagonal, double *off) {
    for (int i = 0; i < d->n_floor; i++) {
        double above = i + 1 < d->n_floor ? dashpot[i + 1] : 0.0;
        diagonal[i] = a0 * d->mass[i] + a1 * (dashpot[i] + above);
        off[i] = -a1 * above;
    }
}

static void warn_negative(struct builder *b, const struct building_draft *d, double a0, double a1) {
    if (a0 < 0.0 || a1 < 0.0) {
        deck_warning(b->deck, &d->damping.word,
                     "Rayleigh coefficient %s is negative: some modes of building %s gain energy",
                     a0 < 0.0 ? "alpha" : "beta", d->name);
    }
}

static double *modal(struct builder *b, const struct building_draft *d, const double *omega,
                     const double *shape) {
    size_t n = (size_t)d->n_floor;
    for (size_t m = 0; m < n; m++) {
        if (omega[m] == 0.0 && d->damping.value[m] > 0.0) {
            deck_error(b->deck, &d->damping.word,
                       "mode %zu of building %s moves it as a rigid body; its ratio can only be 0",
                       m + 1, d->name);
            return NULL;
        }
    }
    double *full = arena_alloc(b->arena, n * n, sizeof *full);
    for (size_t m = 0; full && m < n; m++) {
        const double *phi = shape + m * n;
        double factor = 2.0 * d->damping.value[m] * omega[m];
        for (size_t i = 0; i < n; i++) {
            for (size_t j = 0; j < n; j++) {
                full[i * n + j] += factor * (d->mass[i] * phi[i]) * (d->mass[j] * phi[j]);
            }
        }
    }
    return full;
}

void damping_matrix(struct builder *b, const struct building_draft *d, const double *omega,
                    const double *shape, struct building *building) {
    size_t n = (size_t)d->n_floor;
    double *diagonal = arena_alloc(b->arena, n, sizeof *diagonal);
    double *off = arena_alloc(b->arena, n, sizeof *off);
    if (!diagonal || !off) {
        return;
    }
    double a0 = 0.0;
    double a1 = 0.0;
    switch (d->damping.kind) {
        case DAMPING_NONE:
            break;
        case DAMPING_RATIOS:
        case DAMPING_COEFFICIENTS:
            if (d->damping.kind == DAMPING_COEFFICIENTS) {
                a0 = d->damping.value[0];
                a1 = d->damping.value[1];
            } else if (!rayleigh(b, d, omega, &a0, &a1)) {
                return;
            }
            warn_negative(b, d, a0, a1);
            tridiagonal(d, a0, a1, d->stiffness, diagonal, off);
            break;
        case DAMPING_DASHPOT:
            tridiagonal(d, 0.0, 1.0, d->damping.value, diagonal, off);
            break;
        case DAMPING_MODAL:
            building->damping_full = modal(b, d, omega, shape);
            break;
    }
    building->damping_diagonal = diagonal;
    building->damping_off = off;
}
