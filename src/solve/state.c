// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/state.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "model/parts.h"
#include "model/struck_column.h"
#include "solve/forcing.h"

static const struct fields_row list[] = {
    FIELD_VALUE(struct state, time),
    FIELD_ARRAY(struct state, u, FIELD_FLOORS),
    FIELD_ARRAY(struct state, v, FIELD_FLOORS),
    FIELD_ARRAY(struct state, a, FIELD_FLOORS),
    FIELD_ARRAY(struct state, base, FIELD_FLOORS),
    FIELD_ARRAY(struct state, total, FIELD_FLOORS),
    FIELD_ARRAY(struct state, drift, FIELD_FLOORS),
    FIELD_ARRAY(struct state, shear, FIELD_FLOORS),
    FIELD_ARRAY(struct state, tangent, FIELD_FLOORS),
    FIELD_ARRAY(struct state, rate, FIELD_FLOORS),
    FIELD_ARRAY(struct state, external, FIELD_FLOORS),
    FIELD_ARRAY(struct state, storey_history, FIELD_STOREY_HISTORIES),
    FIELD_ARRAY(struct state, scratch, FIELD_PART_SCRATCH),
    FIELD_VALUE(struct state, n_live),
    FIELD_ARRAY(struct state, live, FIELD_LINKS),
    FIELD_ARRAY(struct state, link, FIELD_LINKS),
    FIELD_ARRAY(struct state, delta, FIELD_LINKS),
    FIELD_ARRAY(struct state, link_history, FIELD_LINK_HISTORIES),
    FIELD_ARRAY(struct state, ground_a, FIELD_GROUNDS),
    FIELD_ARRAY(struct state, ground_v, FIELD_GROUNDS),
    FIELD_ARRAY(struct state, ground_u, FIELD_GROUNDS),
};
const struct fields state_fields = FIELDS(list);

static const struct fields_row memory_list[] = {
    FIELD_ARRAY(struct memory, tangent, FIELD_FLOORS),
    FIELD_ARRAY(struct memory, part_tangent, FIELD_PART_TANGENTS),
    FIELD_ARRAY(struct memory, resolved, FIELD_LINKS),
    FIELD_VALUE(struct memory, unresolved),
};
const struct fields state_memory_fields = FIELDS(memory_list);

bool state_alloc(struct state *s, const struct model *m, struct arena *a) {
    return fields_alloc(&state_fields, m, s, a);
}

bool state_memory_alloc(struct memory *s, const struct model *m, struct arena *a) {
    s->unresolved = -1;
    if (!fields_alloc(&state_memory_fields, m, s, a)) {
        return false;
    }
    memcpy(s->tangent, m->chain.stiffness, (size_t)m->n_dof * sizeof *s->tangent);
    for (const struct building *g = m->building; g < m->building + m->n_body; g++) {
        if (g->predictable && g->n_part > 0) {
            parts_initial(g, s->part_tangent + g->part_tangent);
        }
    }
    return true;
}

void state_assert(const struct state *s, const struct model *m) {
    const double *const array[] = {s->u, s->v, s->a, s->base, s->total, s->drift, s->shear};
    for (size_t i = 0; i < sizeof array / sizeof array[0]; i++) {
        lanes_assert(array[i], m->n_dof);
    }
    assert(s->u[m->n_dof] == 0.0 && s->v[m->n_dof] == 0.0);
    assert(m->chain.n == lanes_whole(m->n_dof) && m->chain.joint[0] == 0.0);
}

void state_open_links(struct state *s) {
    for (int i = 0; i < s->n_live; i++) {
        s->link[s->live[i]] = (struct link_state){0};
    }
    s->n_live = 0;
}

void state_open_link(struct state *s, int k) {
    int i = 0;
    while (s->live[i] != k) {
        i++;
        assert(i < s->n_live);
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

void state_storeys(struct state *s, const struct model *m, const struct building *g,
                   const double *from, double *after) {
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        const struct storey *law = &m->storey[i];
        const struct storey_response r = law->law->respond(
            law->constant, from + law->history, s->drift[i], after ? after + law->history : NULL);
        s->shear[i] = r.shear;
        s->tangent[i] = r.tangent;
    }
    // As in storey_respond; it would take time in each storey without P-delta.
    for (int i = g->first; g->pdelta && i < g->first + g->n_dof; i++) {
        s->shear[i] -= m->storey[i].pdelta * s->drift[i];
        s->tangent[i] -= m->storey[i].pdelta;
    }
}

void state_rates(struct state *s, const struct building *g, const double *v) {
    for (int i = g->first; g->n_part > 0 && !g->elastic && i < g->first + g->n_dof; i++) {
        s->rate[i] = v[i] - (i > g->first ? v[i - 1] : 0.0);
    }
}

void state_parts(struct state *s, const struct building *g, const double *from, double *after) {
    const struct part_sums sums = {.shear = s->shear + g->first, .scratch = s->scratch};
    parts_respond(g, from, s->drift + g->first, s->rate + g->first, &sums, after);
}

// Drifts of the storeys below each floor, and shears of elastic storeys.
LANES static void state_strain(const struct chain *c, const double *restrict u,
                               double *restrict drift, double *restrict shear) {
    const double *restrict k = c->stiffness;
    for (int i = 0, n = lanes_rounded(c->n); i < n; i++) {
        double d = u[i] - c->joint[i] * u[i - 1];
        drift[i] = d;
        shear[i] = k[i] * d;
    }
}

void state_forces(struct state *s, const struct model *m, const double *from, double *after) {
    state_strain(&m->chain, s->u, s->drift, s->shear);
    for (int k = 0; !m->elastic && k < m->n_body; k++) {
        if (!m->building[k].elastic) {
            state_storeys(s, m, &m->building[k], from, after);
        }
    }
    for (int k = 0; m->chain.parts && k < m->n_body; k++) {
        if (m->building[k].n_part > 0) {
            state_rates(s, &m->building[k], s->v);
            state_parts(s, &m->building[k], from, after);
        }
    }
}

void state_totals(struct state *s, const struct model *m) {
    for (int i = 0; i < m->n_dof; i++) {
        s->total[i] = s->a[i] + s->base[i];
    }
}

void state_complete(struct state *s, const struct model *m) {
    state_assert(s, m);
    if (!m->adaptive) {
        forcing_floors(s, m, NULL, s->time);
    }
    if (state_is_linear(m)) {
        state_forces(s, m, s->storey_history, NULL);
    }
    state_totals(s, m);
}

double state_rounding(const struct link *l, const double *x) {
    return 4.0 * DBL_EPSILON * link_size(l, x);
}

// The deformation of link k that its law gets.
static double state_depth(const struct state *s, const struct model *m, int k) {
    return m->link[k].bilateral ? s->delta[k] : fmax(s->delta[k], 0.0);
}

double state_link_force(const struct state *s, const struct model *m, int k) {
    const struct link *l = &m->link[k];
    return l->law
        ->force(l->constant, s->link_history + l->history, state_depth(s, m, k),
                state_rate(s, m, k))
        .force;
}

double state_penetration(const struct state *s, const struct model *m, int k) {
    return state_gap(&m->link[k], m, s->u, s->ground_u) - m->link[k].gap;
}

double state_pressing(const struct state *s, const struct model *m, int k) {
    return state_gap(&m->link[k], m, s->a, s->ground_a);
}

double state_rate(const struct state *s, const struct model *m, int k) {
    return state_gap(&m->link[k], m, s->v, s->ground_v);
}

void state_struck(const struct state *s, const struct model *m, double *u) {
    for (int i = 0; i < m->n_column; i++) {
        const int spring = struck_column_spring(m, i), point = m->column[i].dof[0];
        if (m->column[i].yields) {
            u[point] = struck_column_elastic(
                &m->column[i], s->u[point], state_penetration(s, m, spring), s->link[spring].force);
        }
    }
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

bool state_rests(const struct state *s, const struct model *m, int k) {
    return s->link[k].closed && m->link[k].law->rebound;
}

void state_push(const struct link *l, const struct model *m, double f, double *x) {
    for (int side = 0; side < 2; side++) {
        const double push = side == 0 ? -f : f;
        for (int i = 0, n = link_entries(l, side); i < n; i++) {
            const struct link_entry e = link_entry(l, side, i);
            x[e.dof] += e.weight * push / m->mass[e.dof];
        }
    }
}

void state_add_link_forces(const struct state *s, const struct model *m, double *floor) {
    for (int i = 0; i < s->n_live; i++) {
        link_push(&m->link[s->live[i]], s->link[s->live[i]].force, floor);
    }
}

void state_commit_links(struct state *s, const struct model *m) {
    for (int i = 0; i < s->n_live; i++) {
        int k = s->live[i];
        const struct link *l = &m->link[k];
        if (s->link[k].closed && l->law->commit) {
            l->law->commit(l->constant, s->link_history + l->history, state_depth(s, m, k),
                           state_rate(s, m, k));
        }
    }
}
