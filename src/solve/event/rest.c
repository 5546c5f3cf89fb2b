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
#include "solve/event/rest.h"

#include <math.h>

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
    int contact;   // on its right; -1: none
    double shift;  // how the ground on its left end moves ahead of its own,
    double y;      // and its motion less that
};

// Neighbours of one motion.
struct rest_block {
    int first;
    double mass, momentum;  // mass infinite: there is a wall
    double y;
};

// The contact at rest with the floor `dof` on its side `side`; -1: none, or *n of them.
static int rest_contact_of(const struct rest_contacts *t, const struct model *m, int side, int dof,
                           int *n) {
    int found = -1;
    *n = 0;
    for (int i = 0; i < t->n && dof != WALL; i++) {
        if (m->link[t->contact[i]].dof[side] == dof) {
            found = t->contact[i];
            *n += 1;
        }
    }
    return found;
}

bool rest_find(const struct state *s, const struct model *m, struct rest_contacts *t) {
    t->n = 0;
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k)) {
            if (t->n == REST_MAX) {
                return false;
            }
            t->contact[t->n++] = k;
        }
    }
    for (int i = 0; i < t->n; i++) {
        const int *dof = m->link[t->contact[i]].dof;
        int left, right;
        rest_contact_of(t, m, 0, dof[0], &left);
        rest_contact_of(t, m, 1, dof[1], &right);
        if (left > 1 || right > 1 || !link_is_plain(&m->link[t->contact[i]])) {
            return false;
        }
    }
    return true;
}

// The row that begins with the left body of contact k. Returns how many bodies it has.
static int rest_line_up(const struct rest_contacts *t, const struct model *m, int k,
                        const double *x, const double *ground, struct rest_body *body) {
    int dof = m->link[k].dof[0], n = 0, beside;
    double shift = 0.0;
    for (;;) {
        const double own = dof == WALL ? 0.0 : x[dof];
        body[n++] = (struct rest_body){dof, k, shift, own - shift};
        if (k < 0) {
            return n;
        }
        shift += state_ground_gap(&m->link[k], m, ground);
        dof = m->link[k].dof[1];
        k = rest_contact_of(t, m, 0, dof, &beside);
    }
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

static int rest_find_blocks(const struct rest_body *body, int n_body, const struct model *m,
                            struct rest_block *block) {
    int n = 0;
    for (int i = 0; i < n_body; i++) {
        const bool wall = body[i].dof == WALL;
        const double mass = wall ? INFINITY : m->mass[body[i].dof];
        const double momentum = wall ? 0.0 : mass * body[i].y;
        block[n++] = (struct rest_block){i, mass, momentum, body[i].y};
        while (n > 1 && rest_join(&block[n - 2], &block[n - 1])) {
            n--;
        }
    }
    return n;
}

// What passes between n neighbours, from left to right, when they get the motion y: the momentum
// that those on the side away from a wall have lost.
static void rest_find_passages(const struct rest_body *body, int n, const struct model *m, double y,
                               struct passage *p) {
    const bool wall = body[0].dof == WALL;
    double passed = 0.0, lost = 0.0, pushes = 0.0;
    for (int i = 0; i < n - 1; i++) {
        const struct rest_body *b = &body[wall ? n - 1 - i : i];
        const int left = wall ? n - 2 - i : i;
        passed += m->mass[b->dof] * (wall ? y - b->y : b->y - y);
        p[left] = (struct passage){.push = fmax(passed, 0.0),
                                   .approach = body[left].y - body[left + 1].y};
        lost += p[left].push * p[left].approach / 2.0;
        pushes += p[left].push;
    }
    for (int i = 0; i < n - 1; i++) {
        p[i].lost = pushes > 0.0 ? lost * p[i].push / pushes : 0.0;
    }
}

static void rest_move(const struct rest_body *body, int n, const struct model *m, double y,
                      double *x, rest_note *note, void *context) {
    struct passage p[REST_MAX];
    rest_find_passages(body, n, m, y, p);
    for (int i = 0; i < n; i++) {
        if (i + 1 < n) {
            note(context, body[i].contact, &p[i]);
        }
        if (body[i].dof != WALL) {
            x[body[i].dof] = y + body[i].shift;
        }
    }
}

void rest_pool(const struct rest_contacts *t, const struct model *m, double *x,
               const double *ground, rest_note *note, void *context) {
    struct rest_body body[REST_MAX + 1];
    struct rest_block block[REST_MAX + 2];
    for (int i = 0; i < t->n; i++) {
        const int k = t->contact[i];
        int beside;
        if (rest_contact_of(t, m, 1, m->link[k].dof[0], &beside) >= 0) {
            continue;
        }
        const int n = rest_line_up(t, m, k, x, ground, body);
        const int n_block = rest_find_blocks(body, n, m, block);
        block[n_block].first = n;
        for (int j = 0; j < n_block; j++) {
            const int first = block[j].first, size = block[j + 1].first - first;
            if (size > 1) {
                rest_move(&body[first], size, m, block[j].y, x, note, context);
            }
        }
    }
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

double rest_rounding(const struct link *l, const double *x) {
    return 16.0 * state_rounding(l, x);
}

static void rest_set_force(void *context, int k, const struct passage *p) {
    struct state *s = context;
    s->link[k].force = p->push;
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
    rest_pool(&t, m, s->a, s->ground_a, rest_set_force, s);
    return true;
}

static void rest_find_forces(struct state *s, const struct model *m) {
    for (int i = 0; i < SWEEPS_MAX; i++) {
        if (rest_sweep(s, m) || (i == SWEEPS_FEW && rest_solve(s, m))) {
            return;
        }
    }
}

// The velocity without regard to where it leads. A contact that has just come to rest is kept from
// moving.
static double rest_free_velocity(const struct state *now, const struct model *m, double h, int k,
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
    double velocity = rest_free_velocity(now, m, h, k, v, a);
    velocity = fmin(velocity, fmax(gentle, (1.0 - share) * fmax(v, 0.0)));
    if (ratio > 0.5 && v <= 0.0) {
        velocity = fmin(velocity, (fmax(-d, 0.0) - drift) / (ratio * h));
    }
    return velocity;
}

void rest_forces(struct state *s, const struct model *m) {
    rest_find_forces(s, m);
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k) && s->link[k].force == 0.0 &&
            state_pressing(s, m, k) < -state_rounding(&m->link[k], s->a)) {
            s->link[k].closed = false;
        }
    }
}
