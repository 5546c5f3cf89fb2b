// SPDX-License-Identifier: GPL-3.0-or-later
// The pushes p solve the complementarity problem r' = r - B M^-1 B' p <= 0, p >= 0, p r' = 0, with
// r the rates at which bodies approach. It is the condition for the least sum of m (x' - x)^2 under
// r' <= 0 (Moreau (1988), Unilateral contact and dry friction in finite freedom dynamics, section
// 5), and in a row of bodies from left to right r' <= 0 says that x' does not fall: a weighted
// isotonic regression. Pooling neighbours that approach into blocks of one motion, sum m x / sum m,
// solves it exactly in as many steps as there are bodies (Barlow et al. (1972), Statistical
// Inference under Order Restrictions, section 1.2), whatever the ratios of the masses, which is
// what sweeps over the contacts suffer from. A block at a wall has the motion of the wall. The
// energy that a block loses, sum p r / 2, is shared out by the pushes, as it is among the many
// small impacts that lead to the same.
#include "solve/event/together.h"

#include <math.h>

// A row of bodies, the contacts between them on their right.
struct bodies {
    int n;
    int contact[TOGETHER_MAX];
    int dof[TOGETHER_MAX + 1];  // WALL at an end
    // Of the body: how the ground on its left end moves ahead of its own, and its motion less that.
    double shift[TOGETHER_MAX + 1], y[TOGETHER_MAX + 1];
};

// Neighbours of one motion.
struct block {
    int first;
    double mass, momentum;  // mass infinite: there is a wall
    double y;
};

// The contact at rest with the floor `dof` on its side `side`; -1: none, or *n of them.
static int find(const struct together *t, const struct model *m, int side, int dof, int *n) {
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

bool together_find(const struct state *s, const struct model *m, struct together *t) {
    t->n = 0;
    for (int k = 0; k < m->n_contact; k++) {
        if (state_rests(s, m, k)) {
            if (t->n == TOGETHER_MAX) {
                return false;
            }
            t->contact[t->n++] = k;
        }
    }
    for (int i = 0; i < t->n; i++) {
        const int *dof = m->link[t->contact[i]].dof;
        int left, right;
        find(t, m, 0, dof[0], &left);
        find(t, m, 1, dof[1], &right);
        if (left > 1 || right > 1 || !link_is_plain(&m->link[t->contact[i]])) {
            return false;
        }
    }
    return true;
}

static void append(struct bodies *b, int dof, double shift, const double *x) {
    b->dof[b->n] = dof;
    b->shift[b->n] = shift;
    b->y[b->n] = (dof == WALL ? 0.0 : x[dof]) - shift;
    b->n++;
}

// The row that begins with the left body of contact k.
static void line_up(const struct together *t, const struct model *m, int k, const double *x,
                    const double *ground, struct bodies *b) {
    int n;
    b->n = 0;
    append(b, m->link[k].dof[0], 0.0, x);
    while (k >= 0) {
        const struct link *l = &m->link[k];
        const int last = b->n - 1;
        b->contact[last] = k;
        append(b, l->dof[1], b->shift[last] + state_ground_gap(l, m, ground), x);
        k = find(t, m, 0, l->dof[1], &n);
    }
}

// Two blocks become one; both at walls stay what they are, as nothing could move them.
static bool pool(struct block *left, const struct block *right) {
    if (!(left->y > right->y) || (isinf(left->mass) && isinf(right->mass))) {
        return false;
    }
    const double y = isinf(left->mass) ? left->y
                     : isinf(right->mass)
                         ? right->y
                         : (left->momentum + right->momentum) / (left->mass + right->mass);
    *left = (struct block){.first = left->first,
                           .mass = left->mass + right->mass,
                           .momentum = left->momentum + right->momentum,
                           .y = y};
    return true;
}

static int find_blocks(const struct bodies *b, const struct model *m, struct block *block) {
    int n = 0;
    for (int i = 0; i < b->n; i++) {
        const bool wall = b->dof[i] == WALL;
        const double mass = wall ? INFINITY : m->mass[b->dof[i]];
        block[n++] = (struct block){
            .first = i, .mass = mass, .momentum = wall ? 0.0 : mass * b->y[i], .y = b->y[i]};
        while (n > 1 && pool(&block[n - 2], &block[n - 1])) {
            n--;
        }
    }
    return n;
}

// What passes between the bodies `first` to `last` when they get the motion y: the momentum that
// those on the side away from a wall have lost.
static void find_passages(const struct bodies *b, const struct model *m, int first, int last,
                          double y, struct passage *p) {
    const bool wall = b->dof[first] == WALL;
    double passed = 0.0, lost = 0.0, pushes = 0.0;
    for (int i = 0; i < last - first; i++) {
        const int body = wall ? last - i : first + i;
        const int left = wall ? body - 1 : body;
        passed += m->mass[b->dof[body]] * (wall ? y - b->y[body] : b->y[body] - y);
        p[left] =
            (struct passage){.push = fmax(passed, 0.0), .approach = b->y[left] - b->y[left + 1]};
        lost += p[left].push * p[left].approach / 2.0;
        pushes += p[left].push;
    }
    for (int i = first; i < last; i++) {
        p[i].lost = pushes > 0.0 ? lost * p[i].push / pushes : 0.0;
    }
}

static void move(const struct bodies *b, const struct model *m, int first, int last, double y,
                 double *x, together_note *note, void *context) {
    struct passage p[TOGETHER_MAX];
    find_passages(b, m, first, last, y, p);
    for (int i = first; i <= last; i++) {
        if (i < last) {
            note(context, b->contact[i], &p[i]);
        }
        if (b->dof[i] != WALL) {
            x[b->dof[i]] = y + b->shift[i];
        }
    }
}

void together_move(const struct together *t, const struct model *m, double *x, const double *ground,
                   together_note *note, void *context) {
    struct bodies b;
    struct block block[TOGETHER_MAX + 1];
    for (int i = 0; i < t->n; i++) {
        const int k = t->contact[i];
        int n;
        if (find(t, m, 1, m->link[k].dof[0], &n) >= 0) {
            continue;
        }
        line_up(t, m, k, x, ground, &b);
        const int n_block = find_blocks(&b, m, block);
        for (int j = 0; j < n_block; j++) {
            const int last = j + 1 < n_block ? block[j + 1].first - 1 : b.n - 1;
            if (last > block[j].first) {
                move(&b, m, block[j].first, last, block[j].y, x, note, context);
            }
        }
    }
}
