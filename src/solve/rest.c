// SPDX-License-Identifier: GPL-3.0-or-later
// The forces solve a linear complementarity problem: with w the relative acceleration of each
// contact, towards each other, f >= 0, w <= 0, f w = 0. Its matrix B M^-1 B' is symmetric and
// positive definite unless contacts are redundant, which facing floors cannot be, so the projected
// Gauss-Seidel iteration converges (Cottle, Pang & Stone (2009), The Linear Complementarity
// Problem, section 5.2). Buildings touch at floors, whose masses are lumped: rows are short chains.
// Where masses differ much that takes long, and rows are solved at once (together.c).
#include "solve/rest.h"

#include <math.h>

#include "solve/together.h"

enum { SWEEPS_FEW = 100, SWEEPS_MAX = 20000 };
static const double TOLERANCE = 1e-13;  // relative change of the forces in a sweep

static void push(struct state *s, const struct model *m, int k, double df) {
    const int *dof = m->link[k].dof;
    s->link[k].force += df;
    if (dof[0] != WALL) {
        s->a[dof[0]] -= df / m->mass[dof[0]];
    }
    if (dof[1] != WALL) {
        s->a[dof[1]] += df / m->mass[dof[1]];
    }
}

static double approach(const struct state *s, const struct model *m, int k) {
    return state_gap(&m->link[k], m, s->a, s->ground_a);
}

// One sweep; true if it changed nothing that matters.
static bool sweep(struct state *s, const struct model *m) {
    double largest = 0.0;
    double change = 0.0;
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k)) {
            double wanted = fmax(s->link[k].force + approach(s, m, k) * m->link[k].mass, 0.0);
            change = fmax(change, fabs(wanted - s->link[k].force));
            largest = fmax(largest, wanted);
            push(s, m, k, wanted - s->link[k].force);
        }
    }
    return change <= TOLERANCE * largest;
}

double rest_rounding(const struct link *l, const double *x) {
    return 16.0 * state_rounding(l, x);
}

static void set_force(void *context, int k, const struct passage *p) {
    struct state *s = context;
    s->link[k].force = p->push;
}

// Finds the forces of rows at once; false: the contacts are no rows.
static bool solve(struct state *s, const struct model *m) {
    struct together t;
    if (!together_find(s, m, &t)) {
        return false;
    }
    for (int i = 0; i < t.n; i++) {
        push(s, m, t.contact[i], -s->link[t.contact[i]].force);
    }
    together_move(&t, m, s->a, s->ground_a, set_force, s);
    return true;
}

static void find_forces(struct state *s, const struct model *m) {
    for (int i = 0; i < SWEEPS_MAX; i++) {
        if (sweep(s, m) || (i == SWEEPS_FEW && solve(s, m))) {
            return;
        }
    }
}

void rest_forces(struct state *s, const struct model *m) {
    find_forces(s, m);
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k) && s->link[k].force == 0.0 &&
            approach(s, m, k) < -state_rounding(&m->link[k], s->a)) {
            s->link[k].closed = false;
        }
    }
}
