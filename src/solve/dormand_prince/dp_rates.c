// SPDX-License-Identifier: GPL-3.0-or-later
// M a = -M a_g + p - C v - storey shears - link forces, building by building, without a matrix of
// the whole.
#include "solve/dormand_prince/dp_rates.h"

#include "core/arena.h"
#include "core/lanes.h"
#include "solve/dormand_prince/dp.h"
#include "solve/dormand_prince/dp_parts.h"

static const struct fields_row list[] = {
    FIELD_ARRAY(struct dp_rates, u, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, v, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, a, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, ground.a, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, ground.v, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, ground.u, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, force, FIELD_LINKS),
    FIELD_ARRAY(struct dp_rates, power, FIELD_LINKS),
    FIELD_ARRAY(struct dp_rates, dfdd, FIELD_LINKS),
    FIELD_ARRAY(struct dp_rates, dfdv, FIELD_LINKS),
    FIELD_VALUE(struct dp_rates, input),
    FIELD_VALUE(struct dp_rates, damping),
    FIELD_VALUE(struct dp_rates, storey),
};
const struct fields dp_rates_fields = FIELDS(list);

bool dp_rates_alloc(struct dp_rates *r, const struct model *m, struct arena *a) {
    return fields_alloc(&dp_rates_fields, m, r, a);
}

// Ground accelerations where there are several.
static void dp_ground_rates(const struct dp_system *s, const struct building *g,
                            struct dp_rates *r) {
    double ground = r->ground.a[g->ground];
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        r->a[i] -= ground;
        r->input -= ground * s->model->mass[i] * r->v[i];
    }
}

// A building with a full damping matrix.
static void dp_full_damping(const struct dp_system *s, const struct building *g,
                            struct dp_rates *r) {
    building_damping_force(g, r->v + g->first, s->damping + g->first);
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        r->a[i] -= s->damping[i] * s->mobility[i];
        r->damping += s->damping[i] * r->v[i];
    }
}

// A storey with a history: its power, and its shear if the law is called.
static void dp_storey_rates(const struct dp_system *s, const struct state *now, int i,
                            struct dp_rates *r) {
    int below = s->below[i];  // at the ground the zero in front of the arrays
    double shear = dp_system_shear(s, now, i, r->u[i] - r->u[below]);
    r->storey += shear * (r->v[i] - r->v[below]);
    if (s->calls[i]) {
        r->a[i] -= shear * s->mobility[i];
    }
    if (s->calls[i] && below >= 0) {
        r->a[below] += shear * s->mobility[below];
    }
}

static void dp_building_rates(const struct dp_system *s, const struct state *now,
                              const struct building *g, struct dp_rates *r) {
    if (s->model->n_ground > 1) {
        dp_ground_rates(s, g, r);
    }
    if (g->damping_full) {
        dp_full_damping(s, g, r);
    }
    if (g->n_part > 0) {
        dp_parts_add(s, now, g, r);
    }
    for (int i = g->first; s->n_inelastic > 0 && i < g->first + g->n_floor; i++) {
        if (s->model->storey[i].law->n_history > 0) {
            dp_storey_rates(s, now, i, r);
        }
    }
}

static void dp_load_rates(const struct dp_system *s, double t, int k, struct dp_rates *r) {
    int i = s->model->load[k].dof;
    double p = forcing_load(&s->forcing, k, t);
    r->a[i] += p * s->mobility[i];
    r->input += p * r->v[i];
}

// Adds what the force of a link, an end of which is a row, does to the accelerations. Not in line,
// as link_end_row.
static __attribute__((noinline)) void dp_push_rows(const struct dp_system *s, const struct link *l,
                                                   double force, double *a) {
    for (int side = 0; side < 2; side++) {
        const double push = side == 0 ? -force : force;
        for (int j = 0, n = link_entries(l, side); j < n; j++) {
            const struct link_entry e = link_entry(l, side, j);
            a[e.dof] += e.weight * push * s->mobility[e.dof];
        }
    }
}

// Link number i of the active ones.
static void dp_link_rates(const struct dp_system *s, const struct state *now, int i,
                          struct dp_rates *r) {
    const struct model *m = s->model;
    int k = now->live[i];
    const struct link *l = &m->link[k];
    double d = dp_system_across(l, m, r->u, r->ground.u) - l->gap;
    double rate = dp_system_across(l, m, r->v, r->ground.v);
    struct contact_response response = dp_system_response(s, now, k, d, rate);
    double force = response.force;
    if (!link_is_plain(l)) {
        dp_push_rows(s, l, force, r->a);
    } else {
        if (l->dof[0] != WALL) {
            r->a[l->dof[0]] -= force * s->mobility[l->dof[0]];
        }
        if (l->dof[1] != WALL) {
            r->a[l->dof[1]] += force * s->mobility[l->dof[1]];
        }
    }
    r->input += force * state_ground_gap(l, m, r->ground.v);
    r->force[i] = force;
    r->power[i] = force * rate;
    r->dfdd[i] = response.dfdd;
    r->dfdv[i] = response.dfdv;
}

void dp_rates_add(const struct dp_system *s, const struct state *now, double t, int building,
                  struct dp_rates *r) {
    const struct model *m = s->model;
    r->input = r->damping = r->storey = 0.0;
    bool all = building == DP_ALL;
    int first = all ? 0 : building, end = all ? m->n_building : building + 1;
    for (int k = first; s->special && k < end; k++) {
        dp_building_rates(s, now, &m->building[k], r);
    }
    for (int k = 0; k < m->n_load; k++) {
        if (all || s->building[m->load[k].dof] == building) {
            dp_load_rates(s, t, k, r);
        }
    }
    for (int i = 0; i < now->n_live; i++) {
        const int *of = m->link[now->live[i]].building;
        if (all || of[0] == building || of[1] == building) {
            dp_link_rates(s, now, i, r);
        }
    }
}

void dp_rates_at(const struct dp_system *s, const struct state *now, double t, int building,
                 struct dp_rates *r) {
    const struct dp_range range = dp_rates_range(s->model, building);
    s->floors->rates(s, dp_rates_ground(s, t, r), range.first, range.end, r);
    if (s->special || now->n_live > 0) {
        dp_rates_add(s, now, t, building, r);
    }
}
