// SPDX-License-Identifier: GPL-3.0-or-later
// With A the effective mass matrices, contacts between floors of one level form rows, whose bodies
// have the masses 1 / (gamma h (A^-1)_ff) against forces that bring them to velocities. Floors
// above and below take hardly part, as A is almost diagonal (quick.c). So one row is solved
// exactly (together.c), whatever the ratios of its masses, and what it does to others is left to
// the next turn, as in a Gauss-Seidel iteration by blocks.
//
// Rounding of the velocities of heavy bodies makes forces that a light one between them feels; a
// sweep over the contacts has to follow.
#include "solve/rest_rows.h"

#include <math.h>

#include "solve/contact.h"
#include "solve/quick.h"
#include "solve/rest.h"

// A body of a row: end `side` of a contact.
static double body_mass(const struct work *w, const struct quick *p, int side) {
    const int dof = p->link->dof[side];
    return dof == WALL ? INFINITY : 1.0 / (w->g * p->column[side][dof - p->first[side]]);
}

// Its velocity without a force of its row: `pushed` is that on it now.
static double body_velocity(const struct work *w, const struct quick *p, int side, double mass,
                            double pushed) {
    const int dof = p->link->dof[side];
    return dof == WALL ? 0.0 : w->v_trial[dof] + w->g * w->correction[dof] - pushed / mass;
}

static void settle(struct work *w, const struct state *now, const struct state *next, int n,
                   const int *contact) {
    double mass[TOGETHER_MAX + 1] = {0.0}, y[TOGETHER_MAX + 1], shift = 0.0;
    struct passage passage[TOGETHER_MAX];
    for (int i = 0; i <= n; i++) {
        const int k = contact[i < n ? i : n - 1];
        const struct quick *p = &w->quick[k];
        const double from_left = i > 0 ? w->quick[contact[i - 1]].force : 0.0;
        const double from_right = i < n ? p->force : 0.0;
        mass[i] = body_mass(w, p, i < n ? 0 : 1);
        y[i] = body_velocity(w, p, i < n ? 0 : 1, mass[i], from_left - from_right) - shift;
        shift += state_ground_gap(p->link, w->model, next->ground_v) -
                 rest_velocity(now, w->model, w->h, k);
    }
    together_push(n + 1, mass, y, passage);
    for (int i = 0; i < n; i++) {
        struct quick *p = &w->quick[contact[i]];
        contact_apply(w, p, passage[i].push - p->force);
    }
}

bool rest_rows_find(const struct work *w, const struct state *next, struct together *t) {
    bool found = w->n_rigid > 1 && together_find(next, w->model, t) && t->n > 1;
    t->n = found ? t->n : 0;
    return found;
}

void rest_rows_settle(struct work *w, const struct state *now, const struct state *next,
                      const struct together *t) {
    int contact[TOGETHER_MAX];
    for (int i = 0; i < t->n; i++) {
        const int n = together_row(t, i, contact);
        if (n > 1) {
            settle(w, now, next, n, contact);
        }
    }
}
