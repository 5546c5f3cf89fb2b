// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/event/equilibrium.h"

#include <math.h>
#include <string.h>

#include "solve/event/rest.h"
#include "solve/forcing.h"
#include "solve/floors/chain.h"

// M a = external - C v - storey shears - link forces; the forces stand in `total` meanwhile.
static void equilibrium_accelerations(struct state *s, const struct model *m) {
    double *force = s->total;
    memset(s->a, 0, (size_t)m->n_dof * sizeof *s->a);
    chain_residual(&m->chain, s->external, s->a, s->damping_force, s->shear, force);
    state_add_link_forces(s, m, force);
    for (int i = 0; i < m->n_dof; i++) {
        s->a[i] = force[i] / m->mass[i];
    }
}

void equilibrium_find(struct state *s, const struct model *m) {
    equilibrium_accelerations(s, m);
    rest_forces(s, m);
    state_totals(s, m);
}

static bool equilibrium_starts_closed(const struct link *l, double delta, double rate) {
    bool rests = delta >= 0.0 && rate == 0.0;
    bool meets = delta > 0.0 || (delta == 0.0 && rate > 0.0);
    return l->bilateral || (l->law->rebound ? rests : meets);
}

static void equilibrium_start_links(struct state *s, const struct model *m) {
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        s->delta[k] = state_penetration(s, m, k);
        if (equilibrium_starts_closed(l, s->delta[k], state_rate(s, m, k))) {
            state_close_link(s, m, k);
        }
    }
}

// Is link k a rigid contact that nothing presses together?
static bool equilibrium_is_idle(const struct state *s, const struct model *m, int k) {
    double least = m->link[k].mass * rest_rounding(&m->link[k], s->a);
    return m->link[k].law->rebound && s->link[k].force <= least;
}

void equilibrium_start(struct state *s, const struct model *m) {
    memcpy(s->u, m->displacement, (size_t)m->n_dof * sizeof *s->u);
    memcpy(s->v, m->velocity, (size_t)m->n_dof * sizeof *s->v);
    s->time = 0.0;
    excitation_at(s, m, 0.0);
    state_reach(s, m, s->u, s->v, s->storey_history);
    equilibrium_start_links(s, m);
    equilibrium_find(s, m);
    state_open_where(s, m, equilibrium_is_idle);
}
