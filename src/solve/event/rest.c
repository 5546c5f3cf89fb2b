// SPDX-License-Identifier: GPL-3.0-or-later
// At an instant the forces solve a linear complementarity problem: with w the relative acceleration
// of each contact, towards each other, f >= 0, w <= 0, f w = 0. Its matrix B M^-1 B' is symmetric
// and positive definite unless contacts are redundant, which facing floors cannot be, so the
// projected Gauss-Seidel iteration converges (Cottle, Pang & Stone (2009), The Linear
// Complementarity Problem, section 5.2). Two floors and a level between them that face the same
// floor are redundant: the accelerations are unique then, the forces are not. Floors have lumped
// masses, so rows of buildings are short chains. Where masses differ much that takes long, and rows
// are solved at once.
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
#include "solve/event/event.h"

#include <math.h>
#include <string.h>

#include "solve/floors/floor_terms.h"
#include "solve/forcing.h"

enum { SWEEPS_FEW = 10, SWEEPS_MAX = 20000 };
static const double TOLERANCE = 1e-13;  // relative change of the forces in a sweep

// Steps of the deck in which a contact at rest changes its velocity, and gives back d.
static const double PACE = 2.0;
static const double SLOW = 4.0;

// Rows of bodies are solved at once. The pushes p solve the complementarity problem
//     r' = r - B M^-1 B' p <= 0, p >= 0, p r' = 0,
// with r the rates at which bodies approach. It is the condition for the least sum of m (x' - x)^2
// under r' <= 0 (Moreau (1988), Unilateral contact and dry friction in finite freedom dynamics,
// section 5). In a row of bodies from left to right, r' <= 0 says that x' does not fall: this is a
// weighted isotonic regression. Pooling neighbours that approach into blocks of one motion, sum m x
// / sum m, solves it exactly in as many steps as there are bodies (Barlow et al. (1972),
// Statistical Inference under Order Restrictions, section 1.2), whatever the ratios of the masses.
// Sweeps over the contacts suffer from those. A block at a wall has the motion of the wall. The
// energy that a block loses, sum p r / 2, is shared out by the pushes, as it is among the many
// small impacts that lead to the same.

// A body of a row.
struct rest_body {
    int dof;       // WALL at an end
    int contact;   // on its right, an index of struct rest_contacts; -1: none
    double shift;  // how the ground on its left end moves ahead of its own,
    double y;      // and its motion less that
};

// Neighbours of one motion.
struct rest_block {
    int first;
    double mass, momentum;  // mass infinite: there is a wall
    double y;
};

bool rest_find(const struct state *s, const struct model *m, struct rest_contacts *t) {
    t->n = 0;
    for (int k = 0; k < m->n_contact; k++) {
        const struct link *l = &m->link[k];
        if (!state_rests(s, m, k)) {
            continue;
        }
        if (t->n == REST_MAX || !link_is_plain(l)) {
            return false;
        }
        for (int i = 0; i < 2 * t->n; i++) {
            const int side = i % 2;
            if (l->dof[side] != WALL && l->dof[side] == m->link[t->contact[i / 2]].dof[side]) {
                return false;
            }
        }
        t->contact[t->n++] = k;
    }
    return true;
}

// The contact of `t` that has the floor `dof` on its side `side`; -1: none.
static int rest_contact_of(const struct rest_contacts *t, const struct model *m, int side,
                           int dof) {
    int i = dof == WALL ? -1 : t->n - 1;
    while (i >= 0 && m->link[t->contact[i]].dof[side] != dof) {
        i--;
    }
    return i;
}

// Two blocks become one; both at walls stay what they are, as nothing could move them.
static bool rest_join(struct rest_block *left, const struct rest_block *right) {
    if (!(left->y > right->y) || (isinf(left->mass) && isinf(right->mass))) {
        return false;
    }
    const double y = isinf(left->mass) ? left->y
                     : isinf(right->mass)
                         ? right->y
                         : (left->momentum + right->momentum) / (left->mass + right->mass);
    *left = (struct rest_block){.first = left->first,
                                .mass = left->mass + right->mass,
                                .momentum = left->momentum + right->momentum,
                                .y = y};
    return true;
}

// The bodies of the row that begins with the left one of contact i, and its blocks. Returns how
// many blocks there are; `first` of the one behind them is the number of bodies.
static int rest_line_up(const struct rest_contacts *t, const struct model *m, int i,
                        const double *x, const double *ground, struct rest_body *body,
                        struct rest_block *block) {
    int dof = m->link[t->contact[i]].dof[0], n = 0, n_block = 0;
    double shift = 0.0;
    for (;;) {
        const bool wall = dof == WALL;
        const double mass = wall ? INFINITY : m->mass[dof], y = (wall ? 0.0 : x[dof]) - shift;
        body[n] = (struct rest_body){dof, i, shift, y};
        block[n_block++] = (struct rest_block){n, mass, wall ? 0.0 : mass * y, y};
        n++;
        while (n_block > 1 && rest_join(&block[n_block - 2], &block[n_block - 1])) {
            n_block--;
        }
        if (i < 0) {
            block[n_block].first = n;
            return n_block;
        }
        const struct link *l = &m->link[t->contact[i]];
        shift += state_ground_gap(l, m, ground);
        dof = l->dof[1];
        i = rest_contact_of(t, m, 0, dof);
    }
}

// Gives n neighbours the motion y. What passes between them, from left to right, is the momentum
// that those on the side away from a wall have lost.
static void rest_move(struct rest_contacts *t, const struct rest_body *body, int n,
                      const struct model *m, double y, double *x) {
    const bool wall = body[0].dof == WALL;
    double passed = 0.0, lost = 0.0, pushes = 0.0;
    for (int i = 0; i < n - 1; i++) {
        const struct rest_body *b = &body[wall ? n - 1 - i : i];
        const struct rest_body *left = &body[wall ? n - 2 - i : i];
        struct passage *p = &t->passage[left->contact];
        passed += m->mass[b->dof] * (wall ? y - b->y : b->y - y);
        *p = (struct passage){
            .pooled = true, .push = fmax(passed, 0.0), .approach = left[0].y - left[1].y};
        lost += p->push * p->approach / 2.0;
        pushes += p->push;
    }
    for (int i = 0; i < n; i++) {
        if (i + 1 < n && pushes > 0.0) {
            struct passage *p = &t->passage[body[i].contact];
            p->lost = lost * p->push / pushes;
        }
        if (body[i].dof != WALL) {
            x[body[i].dof] = y + body[i].shift;
        }
    }
}

void rest_pool(struct rest_contacts *t, const struct model *m, double *x, const double *ground) {
    struct rest_body body[REST_MAX + 1];
    struct rest_block block[REST_MAX + 2];
    memset(t->passage, 0, (size_t)t->n * sizeof *t->passage);
    for (int i = 0; i < t->n; i++) {
        if (rest_contact_of(t, m, 1, m->link[t->contact[i]].dof[0]) >= 0) {
            continue;  // it is within a row
        }
        const int n_block = rest_line_up(t, m, i, x, ground, body, block);
        for (int j = 0; j < n_block; j++) {
            const int first = block[j].first, size = block[j + 1].first - first;
            if (size > 1) {
                rest_move(t, &body[first], size, m, block[j].y, x);
            }
        }
    }
}

double rest_rounding(const struct link *l, const double *x) {
    return 16.0 * state_rounding(l, x);
}

double rest_velocity(const struct state *now, const struct model *m, double h, int k) {
    const double d = now->delta[k];
    const double v = state_rate(now, m, k);
    const double a = state_pressing(now, m, k);
    const double ratio = m->beta / m->gamma;  // the step leads to d + drift + ratio h velocity
    const double drift = h * ((1.0 - ratio) * v - (ratio - 0.5) * h * a);
    const double gentle = -(d + drift) / (SLOW * m->dt + ratio * h);
    const double share = fmin(h / m->dt, 1.0);
    // Without regard to where it leads. A contact that has just come to rest is kept from moving.
    const double wanted = (-d / (SLOW * m->dt) - v) / (PACE * m->dt);
    const bool has_rested = now->link[k].t_close < now->time;
    double velocity = has_rested ? v + h * (a + m->gamma * share * (wanted - a)) : fmax(v, 0.0);
    velocity = fmin(velocity, fmax(gentle, (1.0 - share) * fmax(v, 0.0)));
    if (ratio > 0.5 && v <= 0.0) {
        velocity = fmin(velocity, (fmax(-d, 0.0) - drift) / (ratio * h));
    }
    return velocity;
}

static void rest_push(struct state *s, const struct model *m, int k, double df) {
    s->link[k].force += df;
    state_push(&m->link[k], m, df, s->a);
}

// One sweep; true if it changed nothing that matters.
static bool rest_sweep(struct state *s, const struct model *m) {
    double largest = 0.0;
    double change = 0.0;
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k)) {
            double wanted = fmax(s->link[k].force + state_pressing(s, m, k) * m->link[k].mass, 0.0);
            change = fmax(change, fabs(wanted - s->link[k].force));
            largest = fmax(largest, wanted);
            rest_push(s, m, k, wanted - s->link[k].force);
        }
    }
    return change <= TOLERANCE * largest;
}

// Finds the forces of rows at once; false: the contacts are no rows.
static bool rest_solve(struct state *s, const struct model *m) {
    struct rest_contacts t;
    if (!rest_find(s, m, &t)) {
        return false;
    }
    for (int i = 0; i < t.n; i++) {
        rest_push(s, m, t.contact[i], -s->link[t.contact[i]].force);
    }
    rest_pool(&t, m, s->a, s->ground_a);
    for (int i = 0; i < t.n; i++) {
        s->link[t.contact[i]].force = t.passage[i].push;
    }
    return true;
}

void rest_equilibrium(struct state *s, const struct model *m) {
    // M a = external - C v - storey shears - link forces; the forces stand in `total` meanwhile.
    double *force = s->total;
    for (int k = 0; k < m->n_body; k++) {
        const int first = m->building[k].first;
        building_damping_force(&m->building[k], s->v + first, force + first);
    }
    for (int i = 0; i < m->n_dof; i++) {
        force[i] = RESIDUAL(s->external[i], force[i], s->shear[i],
                            m->chain.joint[i + 1] * s->shear[i + 1]);
    }
    state_add_link_forces(s, m, force);
    for (int i = 0; i < m->n_dof; i++) {
        s->a[i] = force[i] / m->mass[i];
    }
    bool found = false;
    for (int i = 0; !found && i < SWEEPS_MAX; i++) {
        found = rest_sweep(s, m) || (i == SWEEPS_FEW && rest_solve(s, m));
    }
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k) && s->link[k].force == 0.0 &&
            state_pressing(s, m, k) < -state_rounding(&m->link[k], s->a)) {
            s->link[k].closed = false;
        }
    }
    state_totals(s, m);
}

// Is link k a rigid contact that nothing presses together?
static bool rest_is_idle(const struct state *s, const struct model *m, int k) {
    double least = m->link[k].mass * rest_rounding(&m->link[k], s->a);
    return m->link[k].law->rebound && s->link[k].force <= least;
}

void rest_start(struct state *s, const struct model *m) {
    memcpy(s->u, m->displacement, (size_t)m->n_dof * sizeof *s->u);
    memcpy(s->v, m->velocity, (size_t)m->n_dof * sizeof *s->v);
    s->time = 0.0;
    forcing_at(s, m, 0.0);
    state_forces(s, m, s->storey_history, s->storey_history);
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        const double delta = s->delta[k] = state_penetration(s, m, k), rate = state_rate(s, m, k);
        const bool rests = delta >= 0.0 && rate == 0.0;
        const bool meets = delta > 0.0 || (delta == 0.0 && rate > 0.0);
        if (l->bilateral || (l->law->rebound ? rests : meets)) {
            state_close_link(s, m, k);
        }
    }
    rest_equilibrium(s, m);
    state_open_where(s, m, rest_is_idle);
}
