// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/state.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "solve/event/rest.h"
#include "solve/excitation.h"
#include "solve/floors/chain.h"

bool state_alloc(struct state *s, const struct model *m, struct arena *a) {
    size_t n_link = (size_t)m->n_link;
    size_t n_ground = (size_t)m->n_ground;
    s->u = lanes_array(a, m->n_dof);
    s->v = lanes_array(a, m->n_dof);
    s->a = lanes_array(a, m->n_dof);
    s->base = lanes_array(a, m->n_dof);
    s->total = lanes_array(a, m->n_dof);
    s->drift = lanes_array(a, m->n_dof);
    s->shear = lanes_array(a, m->n_dof);
    s->damping_force = lanes_array(a, m->n_dof);
    s->external = lanes_array(a, m->n_dof);
    s->storey_history = arena_alloc(a, (size_t)m->n_storey_history, sizeof(double));
    s->live = arena_alloc(a, n_link, sizeof *s->live);
    s->link = lanes_lines(a, n_link, sizeof *s->link);
    s->delta = arena_alloc(a, n_link + LANES_WIDTH, sizeof(double));
    s->link_history = arena_alloc(a, (size_t)m->n_link_history, sizeof(double));
    s->ground_a = arena_alloc(a, n_ground, sizeof(double));
    s->ground_v = arena_alloc(a, n_ground, sizeof(double));
    s->ground_u = arena_alloc(a, n_ground, sizeof(double));
    return !arena_failed(a);
}

void state_open_links(struct state *s) {
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        s->link[k] = (struct link_state){0};
    }
    s->n_live = 0;
}

void state_open_link(struct state *s, int k) {
    int i = 0;
    while (s->live[i] != k) {
        i++;
    }
    s->n_live--;
    memmove(s->live + i, s->live + i + 1, (size_t)(s->n_live - i) * sizeof *s->live);
    s->link[k] = (struct link_state){0};
}

void state_open_where(struct state *s, const struct model *m, state_question *opens) {
    for (int i = s->n_live - 1; i >= 0; i--) {
        if (opens(s, m, s->live[i])) {
            state_open_link(s, s->live[i]);
        }
    }
}

static void inelastic_shears(struct state *s, const struct model *m) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        for (int i = g->first; !g->elastic && i < g->first + g->n_floor; i++) {
            const struct storey *law = &m->storey[i];
            s->shear[i] =
                law->law->shear(law->constant, s->storey_history + law->history, s->drift[i]).shear;
        }
    }
}

static void full_damping(struct state *s, const struct model *m, const double *v) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        if (g->damping_full) {
            building_damping_force(g, v + g->first, s->damping_force + g->first);
        }
    }
}

void state_internal_forces(struct state *s, const struct model *m, const double *u,
                           const double *v) {
    chain_forces(&m->chain, u, v, s->drift, s->shear, s->damping_force);
    if (m->n_storey_history > 0) {
        inelastic_shears(s, m);
    }
    if (m->chain.full_damping) {
        full_damping(s, m, v);
    }
}

void state_totals(struct state *s, const struct model *m) {
    for (int i = 0; i < m->n_dof; i++) {
        s->total[i] = s->a[i] + s->base[i];
    }
}

void state_complete(struct state *s, const struct model *m) {
    if (!state_is_linear(m)) {
        return;
    }
    if (!m->adaptive) {
        excitation_floors(s, m, s->time);
    }
    state_internal_forces(s, m, s->u, s->v);
    state_totals(s, m);
}

double state_gap(const struct link *l, const struct model *m, const double *u,
                 const double *ground) {
    double delta = 0.0;
    if (l->dof[0] != WALL) {
        delta += u[l->dof[0]];
    }
    if (l->dof[1] != WALL) {
        delta -= u[l->dof[1]];
    }
    return delta + state_ground_gap(l, m, ground);
}

double state_rounding(const struct link *l, const double *x) {
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        sum += l->dof[i] == WALL ? 0.0 : fabs(x[l->dof[i]]);
    }
    return 4.0 * DBL_EPSILON * sum;
}

double state_link_force(const struct state *s, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    double d = l->bilateral ? s->delta[k] : fmax(s->delta[k], 0.0);
    return l->law->force(l->constant, s->link_history + l->history, d, state_rate(s, m, k)).force;
}

double state_rate(const struct state *s, const struct model *m, int k) {
    return state_gap(&m->link[k], m, s->v, s->ground_v);
}

void state_close_link(struct state *s, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    state_enliven(s, k);
    s->link[k].closed = true;
    s->link[k].n_past = 0;
    s->link[k].t_close = s->time;
    s->link[k].v_close = fmax(state_rate(s, m, k), 0.0);
    if (l->law->close) {
        l->law->close(l->constant, s->link[k].v_close, s->link_history + l->history);
    }
    s->link[k].force = l->law->rebound ? 0.0 : state_link_force(s, m, k);
}

static bool starts_closed(const struct link *l, double delta, double rate) {
    bool rests = delta >= 0.0 && rate == 0.0;
    bool meets = delta > 0.0 || (delta == 0.0 && rate > 0.0);
    return l->bilateral || (l->law->rebound ? rests : meets);
}

static void start_links(struct state *s, const struct model *m) {
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        s->delta[k] = state_gap(l, m, s->u, s->ground_u) - l->gap;
        if (starts_closed(l, s->delta[k], state_rate(s, m, k))) {
            state_close_link(s, m, k);
        }
    }
}

// Is link k a rigid contact that nothing presses together?
static bool is_idle(const struct state *s, const struct model *m, int k) {
    double least = m->link[k].mass * rest_rounding(&m->link[k], s->a);
    return m->link[k].law->rebound && s->link[k].force <= least;
}

bool state_rests(const struct state *s, const struct model *m, int k) {
    return s->link[k].closed && m->link[k].law->rebound;
}

void state_push(const struct link *l, const struct model *m, double f, double *x) {
    if (l->dof[0] != WALL) {
        x[l->dof[0]] -= f / m->mass[l->dof[0]];
    }
    if (l->dof[1] != WALL) {
        x[l->dof[1]] += f / m->mass[l->dof[1]];
    }
}

void state_add_link_forces(const struct state *s, const struct model *m, double *floor) {
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        const int *dof = m->link[k].dof;
        if (dof[0] != WALL) {
            floor[dof[0]] -= s->link[k].force;
        }
        if (dof[1] != WALL) {
            floor[dof[1]] += s->link[k].force;
        }
    }
}

// M a = external - C v - storey shears - link forces; the forces stand in `total` meanwhile.
static void accelerations(struct state *s, const struct model *m) {
    double *force = s->total;
    memset(s->a, 0, (size_t)m->n_dof * sizeof *s->a);
    chain_residual(&m->chain, s->external, s->a, s->damping_force, s->shear, force);
    state_add_link_forces(s, m, force);
    for (int i = 0; i < m->n_dof; i++) {
        s->a[i] = force[i] / m->mass[i];
    }
}

void state_equilibrium(struct state *s, const struct model *m) {
    accelerations(s, m);
    rest_forces(s, m);
    state_totals(s, m);
}

void state_commit_storeys(struct state *s, const struct model *m) {
    for (int i = 0; m->n_storey_history > 0 && i < m->n_dof; i++) {
        const struct storey *law = &m->storey[i];
        if (law->law->commit) {
            law->law->commit(law->constant, s->storey_history + law->history, s->drift[i]);
        }
    }
}

void state_commit_links(struct state *s, const struct model *m) {
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        const struct link *l = &m->link[k];
        if (s->link[k].closed && l->law->commit) {
            l->law->commit(l->constant, s->link_history + l->history, fmax(s->delta[k], 0.0),
                           state_rate(s, m, k));
        }
    }
}

void state_start(struct state *s, const struct model *m) {
    memcpy(s->u, m->displacement, (size_t)m->n_dof * sizeof *s->u);
    memcpy(s->v, m->velocity, (size_t)m->n_dof * sizeof *s->v);
    s->time = 0.0;
    excitation_at(s, m, 0.0);
    state_internal_forces(s, m, s->u, s->v);
    state_commit_storeys(s, m);
    start_links(s, m);
    state_equilibrium(s, m);
    state_open_where(s, m, is_idle);
}
