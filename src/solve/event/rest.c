// SPDX-License-Identifier: GPL-3.0-or-later
// At an instant the forces solve a linear complementarity problem: with w the relative acceleration
// of each contact, towards each other, f >= 0, w <= 0, f w = 0. Its matrix B M^-1 B' is symmetric
// and positive definite unless contacts are redundant, which facing floors cannot be, so the
// projected Gauss-Seidel iteration converges (Cottle, Pang & Stone (2009), The Linear
// Complementarity Problem, section 5.2). Two floors and a level between them that face the same
// floor are redundant: the accelerations are unique then, the forces are not. Floors have lumped
// masses, so rows of buildings are short chains. Where masses differ much that takes long, and rows
// are solved at once (together.c).
//
// In a step, a contact gives back what rounding and the motion of the ground let it stray from d =
// 0, and it takes its time: its velocity v tends to V = -d / (4 dt), dt the step of the deck, and
// its acceleration, in a share h / dt of a step by that share, to (V - v) / (2 dt). So d, v and a
// decay, however steps are split: the largest eigenvalue of a whole step is 0.71 to 0.77 for beta
// from 0 to 1 and gamma from 1/2 to 1. A velocity to be reached within a step of any length would
// take accelerations beyond all bounds where events follow each other at once, and where gamma =
// 1/2 the acceleration would alternate for ever after; d = 0 likewise.
//
// Bodies that have come apart while at rest, by h^2 |a| where their accelerations have parted them
// at the start of a step, may not overshoot on their way back: v is V at most, with d at the end of
// the step, or what a share of it leaves of v. And where 2 beta > gamma a velocity of zero or less
// may lead inside, by h^2 |a| (beta / gamma - 1/2): there d = 0 counts too, and what asks for the
// larger force prevails.
#include "solve/event/rest.h"

#include <math.h>

#include "solve/event/together.h"

enum { SWEEPS_FEW = 10, SWEEPS_MAX = 20000 };
static const double TOLERANCE = 1e-13;  // relative change of the forces in a sweep

// Steps of the deck in which a contact at rest changes its velocity, and gives back d.
static const double PACE = 2.0;
static const double SLOW = 4.0;

static void push(struct state *s, const struct model *m, int k, double df) {
    s->link[k].force += df;
    state_push(&m->link[k], m, df, s->a);
}

// One sweep; true if it changed nothing that matters.
static bool sweep(struct state *s, const struct model *m) {
    double largest = 0.0;
    double change = 0.0;
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k)) {
            double wanted = fmax(s->link[k].force + state_pressing(s, m, k) * m->link[k].mass, 0.0);
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

// The velocity without regard to where it leads. A contact that has just come to rest is kept from
// moving.
static double free_velocity(const struct state *now, const struct model *m, double h, int k,
                            double v, double a) {
    if (!(now->link[k].t_close < now->time)) {
        return fmax(v, 0.0);
    }
    const double wanted = (-now->delta[k] / (SLOW * m->dt) - v) / (PACE * m->dt);
    return v + h * (a + m->gamma * fmin(h / m->dt, 1.0) * (wanted - a));
}

double rest_velocity(const struct state *now, const struct model *m, double h, int k) {
    const double d = now->delta[k];
    const double v = state_rate(now, m, k);
    const double a = state_pressing(now, m, k);
    const double ratio = m->beta / m->gamma;  // the step leads to d + drift + ratio h velocity
    const double drift = h * ((1.0 - ratio) * v - (ratio - 0.5) * h * a);
    const double gentle = -(d + drift) / (SLOW * m->dt + ratio * h);
    const double share = fmin(h / m->dt, 1.0);
    double velocity = free_velocity(now, m, h, k, v, a);
    velocity = fmin(velocity, fmax(gentle, (1.0 - share) * fmax(v, 0.0)));
    if (ratio > 0.5 && v <= 0.0) {
        velocity = fmin(velocity, (fmax(-d, 0.0) - drift) / (ratio * h));
    }
    return velocity;
}

void rest_forces(struct state *s, const struct model *m) {
    find_forces(s, m);
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k) && s->link[k].force == 0.0 &&
            state_pressing(s, m, k) < -state_rounding(&m->link[k], s->a)) {
            s->link[k].closed = false;
        }
    }
}
