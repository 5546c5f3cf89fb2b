// SPDX-License-Identifier: GPL-3.0-or-later
// The damping matrix C of a building (Chopra, Dynamics of Structures, section 11.4).
//
// Rayleigh damping: C = a0 M + a1 K, where K is the initial stiffness. The damping ratios of two
// modes give a0 and a1: zeta_i = a0 / (2 w_i) + a1 w_i / 2. A building of one storey has
// stiffness-proportional damping, a1 = 2 zeta / w.
// Modal damping: C = M Phi diag(2 zeta w) Phi^T M, a full matrix.
//
// Statements add up. The coefficients, the dashpots of each storey and the ratios of each mode are
// summed first, in the order of the deck. Then C is computed once from the sums. So C is the same
// as from one statement with these sums.
#include "model/finish.h"

#include <assert.h>

#include "model/parts.h"

// The sums of all statements of a building.
struct sums {
    double a0, a1;                         // Rayleigh
    double *dashpot;                       // (n) [F T/L] of each storey
    double *ratio;                         // (n) of each mode; NULL: no statement gives any
    const struct damping_draft *rayleigh;  // the last statement of it; NULL: there is none
};

bool damping_is_modal(const struct building_draft *d) {
    const struct damping_draft *q = d->damping.item;
    bool modal = false;
    for (int i = 0; i < d->damping.n; i++) {
        modal |= q[i].kind == DAMPING_MODAL;
    }
    return modal;
}

// Computes a0 and a1 from the ratios of two modes; false after a report.
static bool rayleigh(struct builder *b, const struct building_draft *d,
                     const struct damping_draft *q, const double *omega, double *a0, double *a1) {
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

// Adds a0 M + a1 K to the bands, where `dashpot` (n) replaces the storey stiffnesses in K.
static void add_tridiagonal(const struct building_draft *d, double a0, double a1,
                            const double *dashpot, double *diagonal, double *off) {
    for (int i = 0; i < d->n_floor; i++) {
        double above = i + 1 < d->n_floor ? dashpot[i + 1] : 0.0;
        diagonal[i] += a0 * d->mass[i] + a1 * (dashpot[i] + above);
        off[i] -= a1 * above;
    }
}

// Only a ratio of 0 is allowed for a rigid-body mode; false after a report.
static bool check_rigid_modes(struct builder *b, const struct building_draft *d,
                              const struct damping_draft *q, const double *omega) {
    for (int m = 0; m < d->n_floor; m++) {
        if (omega[m] == 0.0 && q->value[m] > 0.0) {
            deck_error(b->deck, &q->word,
                       "mode %d of building %s moves it as a rigid body; its ratio can only be 0",
                       m + 1, d->name);
            return false;
        }
    }
    return true;
}

static void add_values(const struct damping_draft *q, double *sum) {
    for (int i = 0; i < q->n; i++) {
        sum[i] += q->value[i];
    }
}

// Adds a statement of Rayleigh damping; false after a report.
static bool add_rayleigh(struct builder *b, const struct building_draft *d,
                         const struct damping_draft *q, const double *omega, struct sums *s) {
    double a0 = q->value[0], a1 = q->value[1];
    if (q->kind == DAMPING_RATIOS && !rayleigh(b, d, q, omega, &a0, &a1)) {
        return false;
    }
    s->a0 += a0;
    s->a1 += a1;
    s->rayleigh = q;
    return true;
}

// Adds one statement; false after a report.
static bool add_statement(struct builder *b, const struct building_draft *d,
                          const struct damping_draft *q, const double *omega, struct sums *s) {
    switch (q->kind) {
        case DAMPING_COEFFICIENTS:
        case DAMPING_RATIOS:
            return add_rayleigh(b, d, q, omega, s);
        case DAMPING_DASHPOT:
            add_values(q, s->dashpot);
            break;
        case DAMPING_MODAL:
            if (!check_rigid_modes(b, d, q, omega)) {
                return false;
            }
            add_values(q, s->ratio);
            break;
    }
    return true;
}

static bool sum_up(struct builder *b, const struct building_draft *d, const double *omega,
                   struct sums *s) {
    const struct damping_draft *q = d->damping.item;
    for (int i = 0; i < d->damping.n; i++) {
        if (!add_statement(b, d, &q[i], omega, s)) {
            return false;
        }
    }
    if (s->a0 < 0.0 || s->a1 < 0.0) {
        deck_warning(b->deck, &s->rayleigh->word,
                     "Rayleigh coefficient %s is negative: some modes of building %s gain energy",
                     s->a0 < 0.0 ? "alpha" : "beta", d->name);
    }
    return true;
}

static void add_modal(const struct building_draft *d, const double *ratio, const double *omega,
                      const double *shape, double *full) {
    size_t n = (size_t)d->n_floor;
    for (size_t m = 0; m < n; m++) {
        const double *phi = shape + m * n;
        double factor = 2.0 * ratio[m] * omega[m];
        for (size_t i = 0; i < n; i++) {
            for (size_t j = 0; j < n; j++) {
                full[i * n + j] += factor * (d->mass[i] * phi[i]) * (d->mass[j] * phi[j]);
            }
        }
    }
}

// Adds a1 K, where K is the stiffness of the parts of the building.
static void add_parts(const struct building *g, double a1, double *full) {
    const int n = g->n_floor;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            full[i * n + j] += a1 * parts_on_floors(g->part_stiffness, n, i, j);
        }
    }
}

// Moves the bands into the full matrix.
static void move_bands(int n_floor, double *diagonal, double *off, double *full) {
    size_t n = (size_t)n_floor;
    for (size_t i = 0; i < n; i++) {
        full[i * n + i] += diagonal[i];
        if (i + 1 < n) {
            full[i * n + i + 1] += off[i];
            full[(i + 1) * n + i] += off[i];
        }
        diagonal[i] = off[i] = 0.0;
    }
}

// Makes the matrix symmetric to the bit.
static void mirror(int n_floor, double *full) {
    size_t n = (size_t)n_floor;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < i; j++) {
            full[i * n + j] = full[j * n + i];
        }
    }
}

void damping_matrix(struct builder *b, const struct building_draft *d, const double *omega,
                    const double *shape, struct building *building) {
    assert(d->n_floor == building->n_floor && (shape || !damping_is_modal(d)));
    size_t n = (size_t)d->n_floor;
    const bool modal = damping_is_modal(d), fills = modal || building->n_part > 0;
    double *diagonal = arena_alloc(b->arena, n, sizeof *diagonal);
    double *off = arena_alloc(b->arena, n, sizeof *off);
    double *full = fills ? arena_alloc(b->arena, n * n, sizeof *full) : NULL;
    struct sums s = {
        .dashpot = arena_alloc(b->arena, n, sizeof *s.dashpot),
        .ratio = modal ? arena_alloc(b->arena, n, sizeof *s.ratio) : NULL,
    };
    if (arena_failed(b->arena) || !sum_up(b, d, omega, &s)) {
        return;
    }
    add_tridiagonal(d, s.a0, s.a1, building->spring, diagonal, off);
    add_tridiagonal(d, 0.0, 1.0, s.dashpot, diagonal, off);
    if (modal) {
        add_modal(d, s.ratio, omega, shape, full);
    }
    if (building->n_part > 0) {
        add_parts(building, s.a1, full);
    }
    if (fills) {
        move_bands(d->n_floor, diagonal, off, full);
        mirror(d->n_floor, full);
    }
    building->damping_diagonal = diagonal;
    building->damping_off = off;
    building->damping_full = full;
    building->damping_alpha = s.a0;
    building->damping_beta = s.a1;
    building->damping = s.rayleigh ? &s.rayleigh->word : NULL;
}
