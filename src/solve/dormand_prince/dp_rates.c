// SPDX-License-Identifier: GPL-3.0-or-later
// M a = -M a_g + p - C v - storey shears - link forces, building by building, without a matrix of
// the whole.
#include "solve/dormand_prince/dp_rates.h"

#include "core/arena.h"
#include "core/lanes.h"

bool dp_rates_alloc(struct dp_rates *r, const struct model *m, struct arena *a) {
    size_t n_link = (size_t)m->n_link;
    size_t n_ground = (size_t)m->n_ground;
    r->u = lanes_array(a, m->n_dof);
    r->v = lanes_array(a, m->n_dof);
    r->a = lanes_array(a, m->n_dof);
    r->force = arena_alloc(a, n_link, sizeof(double));
    r->power = arena_alloc(a, n_link, sizeof(double));
    r->dfdd = arena_alloc(a, n_link, sizeof(double));
    r->dfdv = arena_alloc(a, n_link, sizeof(double));
    r->ground.a = arena_alloc(a, n_ground, sizeof(double));
    r->ground.v = arena_alloc(a, n_ground, sizeof(double));
    r->ground.u = arena_alloc(a, n_ground, sizeof(double));
    return !arena_failed(a);
}

// Accelerations of all floors from r->u and r->v without links, loads and what is special, under
// the ground acceleration `ground`; as take_floors of dp_floors.h.
LANES static void floor_rates(const struct dp_system *s, double ground, struct dp_rates *r) {
    double *const *row = s->row;
    const double *u = r->u, *v = r->v;
    double *a = r->a;
    LANES_LOOP
    for (int i = 0, end = lanes_whole(s->model->n_dof); i < end; i++) {
        double spring =
            row[DP_K_BELOW][i] * u[i - 1] + row[DP_K_OWN][i] * u[i] + row[DP_K_ABOVE][i] * u[i + 1];
        double still = row[DP_CONSTANT][i] - ground * row[DP_GROUND][i] - spring;
        double joined = row[DP_C_BELOW][i] * v[i - 1] + row[DP_C_ABOVE][i] * v[i + 1];
        a[i] = still - row[DP_C_OWN][i] * v[i] - joined;
    }
}

// Ground accelerations where there are several.
static void ground_rates(const struct dp_system *s, struct dp_rates *r) {
    for (int k = 0; k < s->model->n_building; k++) {
        const struct building *g = &s->model->building[k];
        double ground = r->ground.a[g->ground];
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            r->a[i] -= ground;
            r->input -= ground * s->model->mass[i] * r->v[i];
        }
    }
}

// Buildings with a full damping matrix.
static void full_damping(const struct dp_system *s, struct dp_rates *r) {
    for (int k = 0; k < s->model->n_building; k++) {
        const struct building *g = &s->model->building[k];
        if (!g->damping_full) {
            continue;
        }
        building_damping_force(g, r->v + g->first, s->damping + g->first);
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            r->a[i] -= s->damping[i] * s->mobility[i];
            r->damping += s->damping[i] * r->v[i];
        }
    }
}

// Storeys with a history: their power, and the shear of those whose law is called.
static void storey_rates(const struct dp_system *s, const struct state *now, struct dp_rates *r) {
    for (int n = 0; n < s->n_inelastic; n++) {
        int i = s->inelastic[n];
        int below = s->below[i];
        double drift = r->u[i] - (below < 0 ? 0.0 : r->u[below]);
        double shear = dp_system_shear(s, now, i, drift);
        r->storey += shear * (r->v[i] - (below < 0 ? 0.0 : r->v[below]));
        if (s->calls[i]) {
            r->a[i] -= shear * s->mobility[i];
        }
        if (s->calls[i] && below >= 0) {
            r->a[below] += shear * s->mobility[below];
        }
    }
}

static void load_rates(const struct dp_system *s, double t, struct dp_rates *r) {
    for (int k = 0; k < s->model->n_load; k++) {
        int i = s->model->load[k].dof;
        double p = forcing_load(&s->forcing, k, t);
        r->a[i] += p * s->mobility[i];
        r->input += p * r->v[i];
    }
}

static void link_rates(const struct dp_system *s, const struct state *now, struct dp_rates *r) {
    const struct model *m = s->model;
    for (int i = 0; i < now->n_live; i++) {
        int k = now->live[i];
        const struct link *l = &m->link[k];
        double d = dp_system_across(l, m, r->u, r->ground.u) - l->gap;
        double rate = dp_system_across(l, m, r->v, r->ground.v);
        struct contact_response response = dp_system_response(s, now, k, d, rate);
        double force = response.force;
        if (l->dof[0] != WALL) {
            r->a[l->dof[0]] -= force * s->mobility[l->dof[0]];
        }
        if (l->dof[1] != WALL) {
            r->a[l->dof[1]] += force * s->mobility[l->dof[1]];
        }
        r->input += force * state_ground_gap(l, m, r->ground.v);
        r->force[i] = force;
        r->power[i] = force * rate;
        r->dfdd[i] = response.dfdd;
        r->dfdv[i] = response.dfdv;
    }
}

void dp_rates_add(const struct dp_system *s, const struct state *now, double t,
                  struct dp_rates *r) {
    const struct model *m = s->model;
    r->input = r->damping = r->storey = 0.0;
    if (m->n_ground > 1) {
        ground_rates(s, r);
    }
    if (m->chain.full_damping) {
        full_damping(s, r);
    }
    if (s->n_inelastic > 0) {
        storey_rates(s, now, r);
    }
    if (m->n_load > 0) {
        load_rates(s, t, r);
    }
    if (now->n_live > 0) {
        link_rates(s, now, r);
    }
}

void dp_rates_at(const struct dp_system *s, const struct state *now, double t, struct dp_rates *r) {
    floor_rates(s, dp_rates_ground(s, t, r), r);
    dp_rates_add(s, now, t, r);
}

// Acceleration of floor i by its storeys and dampers.
static double own_acceleration(const struct dp_system *s, const struct state *now,
                               const struct dp_rates *r, int i) {
    const struct building *g = &s->model->building[s->building[i]];
    const double *u = r->u + i;
    const double *v = r->v + i;
    double a = s->row[DP_CONSTANT][i];
    a -= s->row[DP_K_BELOW][i] * u[-1] + s->row[DP_K_OWN][i] * u[0] + s->row[DP_K_ABOVE][i] * u[1];
    a -= s->row[DP_C_BELOW][i] * v[-1] + s->row[DP_C_OWN][i] * v[0] + s->row[DP_C_ABOVE][i] * v[1];
    if (g->damping_full) {
        building_damping_force(g, r->v + g->first, s->damping + g->first);
        a -= s->damping[i] * s->mobility[i];
    }
    if (s->calls[i]) {
        double below = s->below[i] < 0 ? 0.0 : u[-1];
        a -= dp_system_shear(s, now, i, u[0] - below) * s->mobility[i];
    }
    if (i + 1 < g->first + g->n_floor && s->calls[i + 1]) {
        a += dp_system_shear(s, now, i + 1, u[1] - u[0]) * s->mobility[i];
    }
    return a;
}

double dp_rates_acceleration(const struct dp_system *s, const struct state *now, double t,
                             struct dp_rates *r, int i) {
    const struct model *m = s->model;
    double a = own_acceleration(s, now, r, i);
    forcing_ground(&s->forcing, t, &r->ground);
    for (int k = 0; k < m->n_load; k++) {
        a += m->load[k].dof == i ? forcing_load(&s->forcing, k, t) * s->mobility[i] : 0.0;
    }
    for (int n = 0; n < now->n_live; n++) {
        const struct link *l = &m->link[now->live[n]];
        if (l->dof[0] == i || l->dof[1] == i) {
            double d = dp_system_across(l, m, r->u, r->ground.u) - l->gap;
            double rate = dp_system_across(l, m, r->v, r->ground.v);
            double force = dp_system_response(s, now, now->live[n], d, rate).force;
            a += (l->dof[0] == i ? -force : force) * s->mobility[i];
        }
    }
    return a;
}
