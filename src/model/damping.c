// SPDX-License-Identifier: GPL-3.0-or-later
// The damping matrix C of a building (Chopra, Dynamics of Structures, section 11.4).
//
// Rayleigh damping: C = a0 M + a1 K, where K is the initial stiffness. The damping ratios of two
// modes give a0 and a1: zeta_i = a0 / (2 w_i) + a1 w_i / 2. A building of one storey has
// stiffness-proportional damping, a1 = 2 zeta / w.
// -storeys leaves storeys out of a1 K: with K on drifts, the rows and columns of other storeys are
// 0. So are those of isolators by default. a0, a1 and the modes stay those of the whole building.
// With -tangent, a1 K is on the tangent stiffness (tangent_damping.c). Modal damping: C = M Phi
// diag(2 zeta w) Phi^T M, a full matrix.
//
// Statements add up. The coefficients, the dashpots of each storey and the ratios of each mode are
// summed first, in the order of the deck. Then C is computed once from the sums. So C is the same
// as from one statement with these sums.
#include "model/finish.h"

#include <assert.h>

#include "model/parts.h"
#include "model/tangent_damping.h"

// The stiffness-proportional part of one statement.
struct proportional {
    double a1;
    const struct damping_draft *of;
    bool tangent;
};

// The sums of all statements of a building.
struct sums {
    double a0, a1;                         // Rayleigh; a1 of statements without -storeys
    double *dashpot;                       // (n) [F T/L] of each storey
    double *ratio;                         // (n) of each mode; NULL: no statement gives any
    const struct damping_draft *rayleigh;  // the last statement of it; NULL: there is none
    int n_apart;                           // parts of statements with -storeys or -tangent
    struct proportional *apart;            // (n_apart)
    bool tangent;                          // the tangent stiffness can change
};

// C, in bands or full, and its dashpots of each storey on the initial stiffness.
struct matrix {
    double *diagonal, *off, *full;  // full NULL: no modes, and no parts that couple storeys
    double *storey;                 // (n)
    double *mark, *marked;          // scratch: (n), (n, n)
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
        return deck_error(b->deck, &q->word,
                          "building %s has stiffness 0: no frequency to fit damping to", d->name);
    }
    if (wi == 0.0 || wj == 0.0 || (wi == wj && q->mode[0] != q->mode[1])) {
        return deck_error(
            b->deck, &q->word,
            "modes %d and %d of building %s have no two frequencies to fit damping to", q->mode[0],
            q->mode[1], d->name);
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
            return deck_error(
                b->deck, &q->word,
                "mode %d of building %s moves it as a rigid body; its ratio can only be 0", m + 1,
                d->name);
        }
    }
    return true;
}

static void add_values(const struct damping_draft *q, double *sum) {
    for (int i = 0; i < q->n; i++) {
        sum[i] += q->value[i];
    }
}

// 1 for the storeys (n) that have a stiffness-proportional part, else 0. `storeys` NULL: all but
// isolators.
static void mark_storeys(const struct building_draft *d, const struct selection *storeys,
                         double *mark) {
    for (int i = 0; i < d->n_floor; i++) {
        mark[i] = !storeys && i + 1 != d->isolated;
    }
    for (int i = 0; storeys && i < storeys->n_floor; i++) {
        mark[storeys->floor[i] - 1] = 1.0;
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
    s->rayleigh = q;
    if (a1 != 0.0 && !q->storeys && d->isolated > 0 && d->n_floor == 1) {
        return deck_error(
            b->deck, &q->word,
            "the only storey of building %s is an isolator, which Rayleigh damping leaves "
            "out; name it with -storeys 1",
            d->name);
    }
    const struct proportional of = {a1, q, q->tangent.text && s->tangent};
    if (q->storeys || of.tangent) {
        s->apart[s->n_apart++] = of;
    } else {
        s->a1 += a1;
    }
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
    bool negative = s->a1 < 0.0;
    for (int k = 0; k < s->n_apart; k++) {
        negative |= s->apart[k].a1 < 0.0;
    }
    if (s->a0 < 0.0 || negative) {
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

// Adds a1 K of the marked storeys, and a0 M.
static void add_proportional(const struct building_draft *d, const struct building *g, double a0,
                             double a1, const struct matrix *c) {
    const int n = g->n_dof;
    for (int i = 0; i < n; i++) {
        c->marked[i] = c->mark[i] * (c->full ? g->spring[i] : g->stiffness[i]);
        c->storey[i] += a1 * (c->mark[i] * g->stiffness[i]);
    }
    add_tridiagonal(d, a0, a1, c->marked, c->diagonal, c->off);
    const bool couples = c->full && g->n_part > 0;
    for (int i = 0; couples && i < n * n; i++) {
        c->marked[i] = c->mark[i / n] * c->mark[i % n] * g->part_stiffness[i];
    }
    for (int i = 0; couples && i < n; i++) {
        for (int j = 0; j < n; j++) {
            c->full[i * n + j] += a1 * parts_on_floors(c->marked, n, i, j);
        }
    }
}

// Adds the parts of statements with -storeys or -tangent. False: no memory.
static bool add_apart(struct arena *a, const struct building_draft *d, struct building *g,
                      const struct sums *s, const struct matrix *c) {
    const int n = g->n_dof;
    for (int k = 0; k < s->n_apart; k++) {
        const struct proportional *p = &s->apart[k];
        mark_storeys(d, p->of->storeys, c->mark);
        if (!p->tangent) {
            add_proportional(d, g, 0.0, p->a1, c);
            continue;
        }
        g->tangent = g->tangent ? g->tangent : tangent_damping_create(a, g);
        for (int i = 0; g->tangent && i < n * n; i++) {
            g->tangent->beta[i] += p->a1 * c->mark[i / n] * c->mark[i % n];
        }
    }
    return !arena_failed(a);
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

// Reports -tangent of a building on a foundation; true if there is one.
static bool refuse_tangent(struct builder *b, const struct building_draft *d,
                           const struct sums *s) {
    for (int k = 0; d->foundation && k < s->n_apart; k++) {
        if (s->apart[k].tangent) {
            deck_error(b->deck, &s->apart[k].of->tangent,
                       "a building on a foundation has no damping on its tangent stiffness; leave "
                       "storeys that yield out with -storeys");
            return true;
        }
    }
    return false;
}

static bool alloc(struct arena *a, const struct building_draft *d, const struct building *g,
                  struct sums *s, struct matrix *c) {
    const size_t n = (size_t)g->n_dof, most = (size_t)d->damping.n;
    const bool modal = damping_is_modal(d);
    *s = (struct sums){
        .dashpot = arena_alloc(a, n, sizeof *s->dashpot),
        .ratio = modal ? arena_alloc(a, n, sizeof *s->ratio) : NULL,
        .apart = arena_alloc(a, most, sizeof *s->apart),
        .tangent = tangent_damping_matters(d, g),
    };
    const bool fills = modal || !parts_are_diagonal(g);
    *c = (struct matrix){
        .diagonal = arena_alloc(a, n, sizeof *c->diagonal),
        .off = arena_alloc(a, n, sizeof *c->off),
        .full = fills ? arena_alloc(a, n * n, sizeof *c->full) : NULL,
        .storey = arena_alloc(a, n, sizeof *c->storey),
        .mark = arena_alloc(a, n, sizeof *c->mark),
        .marked = arena_alloc(a, fills ? n * n : n, sizeof *c->marked),
    };
    return !arena_failed(a);
}

void damping_matrix(struct builder *b, const struct building_draft *d, const double *omega,
                    const double *shape, struct building *building) {
    assert(d->n_floor == building->n_dof && (shape || !damping_is_modal(d)));
    struct sums s;
    struct matrix c;
    if (!alloc(b->arena, d, building, &s, &c)) {
        return;
    }
    building->damping_diagonal = c.diagonal;  // 0 if a statement is wrong
    building->damping_off = c.off;
    building->damping_full = c.full;
    building->damping_storey = c.storey;
    if (!sum_up(b, d, omega, &s) || refuse_tangent(b, d, &s)) {
        return;
    }
    mark_storeys(d, NULL, c.mark);
    add_proportional(d, building, s.a0, s.a1, &c);
    if (!add_apart(b->arena, d, building, &s, &c)) {
        return;
    }
    add_tridiagonal(d, 0.0, 1.0, s.dashpot, c.diagonal, c.off);
    if (s.ratio) {
        add_modal(d, s.ratio, omega, shape, c.full);
    }
    if (c.full) {
        move_bands(d->n_floor, c.diagonal, c.off, c.full);
        mirror(d->n_floor, c.full);
    }
    building->damping_alpha = s.a0;
    building->damping = s.rayleigh ? &s.rayleigh->word : NULL;
}
