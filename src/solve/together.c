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
#include "solve/together.h"

#include <math.h>

// Neighbours of one motion.
struct block {
    int first;
    double mass, momentum;  // mass infinite: there is a wall
    double y;
};

// How many contacts at rest have the floor `dof` on that side; one of them into *found, or -1.
static int find(const struct together *t, const struct model *m, int side, int dof, int *found) {
    int n = 0;
    *found = -1;
    for (int i = 0; i < t->n && dof != WALL; i++) {
        if (m->link[t->contact[i]].dof[side] == dof) {
            *found = i;
            n++;
        }
    }
    return n;
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
    return together_line_up(t, m);
}

bool together_line_up(struct together *t, const struct model *m) {
    for (int i = 0; i < t->n; i++) {
        const int *dof = m->link[t->contact[i]].dof;
        int found;
        bool rows = find(t, m, 0, dof[0], &found) <= 1 && find(t, m, 1, dof[1], &found) <= 1;
        if (!rows) {
            return false;
        }
        find(t, m, 1, dof[0], &t->left[i]);
        find(t, m, 0, dof[1], &t->right[i]);
    }
    return true;
}

int together_row(const struct together *t, int i, int *contact) {
    int n = 0;
    for (int j = t->left[i] < 0 ? i : -1; j >= 0; j = t->right[j]) {
        contact[n++] = t->contact[j];
    }
    return n;
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

static int find_blocks(int n, const double *mass, const double *y, struct block *block) {
    int n_block = 0;
    for (int i = 0; i < n; i++) {
        block[n_block++] = (struct block){.first = i,
                                          .mass = mass[i],
                                          .momentum = isinf(mass[i]) ? 0.0 : mass[i] * y[i],
                                          .y = y[i]};
        while (n_block > 1 && pool(&block[n_block - 2], &block[n_block - 1])) {
            n_block--;
        }
    }
    return n_block;
}

// What passes between the bodies `first` to `last` when they get the motion `common`: the momentum
// that those on the side away from a wall have lost.
static void find_passages(const double *mass, const double *y, int first, int last, double common,
                          struct passage *p) {
    const bool wall = isinf(mass[first]);
    double passed = 0.0, lost = 0.0, pushes = 0.0;
    for (int i = 0; i < last - first; i++) {
        const int body = wall ? last - i : first + i;
        const int left = wall ? body - 1 : body;
        passed += mass[body] * (wall ? common - y[body] : y[body] - common);
        p[left] = (struct passage){
            .joined = true, .push = fmax(passed, 0.0), .approach = y[left] - y[left + 1]};
        lost += p[left].push * p[left].approach / 2.0;
        pushes += p[left].push;
    }
    for (int i = first; i < last; i++) {
        p[i].lost = pushes > 0.0 ? lost * p[i].push / pushes : 0.0;
    }
}

void together_push(int n, const double *mass, double *y, struct passage *p) {
    struct block block[TOGETHER_MAX + 1];
    const int n_block = find_blocks(n, mass, y, block);
    for (int i = 0; i < n - 1; i++) {
        p[i] = (struct passage){.joined = false};
    }
    for (int j = 0; j < n_block; j++) {
        const int first = block[j].first;
        const int last = (j + 1 < n_block ? block[j + 1].first : n) - 1;
        find_passages(mass, y, first, last, block[j].y, p);
        for (int i = first; i <= last; i++) {
            y[i] = block[j].y;
        }
    }
}

// Moves the row of these n contacts.
static void move(const struct model *m, int n, const int *contact, double *x, const double *ground,
                 together_note *note, void *context) {
    double mass[TOGETHER_MAX + 1] = {0.0}, y[TOGETHER_MAX + 1], shift[TOGETHER_MAX + 1] = {0.0};
    struct passage p[TOGETHER_MAX];
    for (int i = 0; i <= n; i++) {
        const int dof = m->link[contact[i < n ? i : n - 1]].dof[i < n ? 0 : 1];
        shift[i] = i > 0 ? shift[i - 1] + state_ground_gap(&m->link[contact[i - 1]], m, ground) : 0;
        mass[i] = dof == WALL ? INFINITY : m->mass[dof];
        y[i] = (dof == WALL ? 0.0 : x[dof]) - shift[i];
    }
    together_push(n + 1, mass, y, p);
    for (int i = 0; i <= n; i++) {
        const int dof = m->link[contact[i < n ? i : n - 1]].dof[i < n ? 0 : 1];
        const bool joined = (i < n && p[i].joined) || (i > 0 && p[i - 1].joined);
        if (joined && dof != WALL) {
            x[dof] = y[i] + shift[i];
        }
        if (i < n && p[i].joined) {
            note(context, contact[i], &p[i]);
        }
    }
}

void together_move(const struct together *t, const struct model *m, double *x, const double *ground,
                   together_note *note, void *context) {
    int contact[TOGETHER_MAX];
    for (int i = 0; i < t->n; i++) {
        const int n = together_row(t, i, contact);
        if (n > 0) {
            move(m, n, contact, x, ground, note, context);
        }
    }
}
