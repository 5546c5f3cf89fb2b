// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/lanes.h"
#include "model/finish.h"

enum { MASS, STIFFNESS, JOINT, BELOW, OWN, ABOVE, N_ARRAY };

static void fill(double *const x[N_ARRAY], struct chain *c, const struct building *g) {
    for (int i = 0; i < g->n_floor; i++) {
        int j = g->first + i;
        x[MASS][j] = g->mass[i];
        x[STIFFNESS][j] = g->spring[i];
        x[JOINT][j] = i > 0 ? 1.0 : 0.0;
        if (!g->damping_full) {
            x[OWN][j] = g->damping_diagonal[i];
            x[BELOW][j] = i > 0 ? g->damping_off[i - 1] : 0.0;
            x[ABOVE][j] = i + 1 < g->n_floor ? g->damping_off[i] : 0.0;
        }
    }
    c->full_damping |= g->damping_full != NULL;
    c->parts |= g->n_part > 0;
}

void finish_chain(struct builder *b, struct model *m) {
    double *x[N_ARRAY];
    for (int i = 0; i < N_ARRAY; i++) {
        x[i] = lanes_array(b->arena, m->n_dof);
    }
    if (arena_failed(b->arena)) {
        return;
    }
    m->chain = (struct chain){
        .n = lanes_whole(m->n_dof),
        .mass = x[MASS],
        .stiffness = x[STIFFNESS],
        .joint = x[JOINT],
        .damping_below = x[BELOW],
        .damping = x[OWN],
        .damping_above = x[ABOVE],
    };
    for (int k = 0; k < m->n_building; k++) {
        fill(x, &m->chain, &m->building[k]);
    }
}
