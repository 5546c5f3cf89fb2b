// SPDX-License-Identifier: GPL-3.0-or-later
// M a = -M a_g + p - C v - storey shears - link forces, building by building, without a matrix of
// the whole.
//
// A step of high order needs a smooth right-hand side. So within a step every law is held on its
// branch, and continued along it where a stage lies beyond: a contact by the tangents at its end
// (d = 0, or v = 0 from the side of its phase), which is exact for laws that are linear there, a
// storey made of straight lines by its line. Where the branch really ends the step is cut; see
// dp_event.c. Other storey laws are called as they are.
#include "solve/dp_system.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"

// How far beyond its drift a storey is asked for its tangent, relative to its drift or to that
// which its shear would take elastically: far above rounding, far below any tolerance.
static const double PROBE = 1e-12;

bool dp_system_alloc(struct dp_system *s, const struct model *m, struct arena *a) {
    size_t n = (size_t)m->n_dof;
    size_t n_link = (size_t)m->n_link;
    *s = (struct dp_system){
        .model = m,
        .mobility = arena_alloc(a, n, sizeof(double)),
        .stiffness = arena_alloc(a, n, sizeof(double)),
        .base = arena_alloc(a, n, sizeof(double)),
        .tangent = arena_alloc(a, n, sizeof(double)),
        .damping = arena_alloc(a, n, sizeof(double)),
        .active = arena_alloc(a, n_link, sizeof *s->active),
        .phase = arena_alloc(a, n_link, sizeof *s->phase),
        .inelastic = arena_alloc(a, n, sizeof *s->inelastic),
        .below = arena_alloc(a, n, sizeof *s->below),
        .calls = arena_alloc(a, n, sizeof *s->calls),
    };
    return s->mobility && s->stiffness && s->base && s->tangent && s->damping && s->active && s->phase &&
           s->inelastic && s->below && s->calls && forcing_alloc(&s->forcing, m, a);
}

bool dp_system_alloc_rates(struct dp_rates *r, const struct model *m, struct arena *a) {
    size_t n_link = (size_t)m->n_link;
    size_t n_ground = (size_t)m->n_ground;
    r->force = arena_alloc(a, n_link, sizeof(double));
    r->power = arena_alloc(a, n_link, sizeof(double));
    r->ground.a = arena_alloc(a, n_ground, sizeof(double));
    r->ground.v = arena_alloc(a, n_ground, sizeof(double));
    r->ground.u = arena_alloc(a, n_ground, sizeof(double));
    return r->force && r->power && r->ground.a && r->ground.v && r->ground.u;
}

static bool is_straight(const struct storey *law) {
    return law->law->n_history == 0 || (law->law->traits & STOREY_STRAIGHT);
}

static struct storey_response storey_at(const struct dp_system *s, const struct state *now, int i,
                                        double drift) {
    const struct storey *law = &s->model->storey[i];
    return law->law->shear(law->constant, now->storey_history + law->history, drift);
}

double dp_system_tangent(const struct dp_system *s, const struct state *now, int i, double drift) {
    return storey_at(s, now, i, drift).tangent;
}

double dp_system_storey_noise(const struct dp_system *s, const struct state *now, int i) {
    double elastic = storey_at(s, now, i, now->drift[i]).shear / s->stiffness[i];
    return PROBE * (fabs(now->drift[i]) + fabs(elastic));
}

void dp_system_branch(struct dp_system *s, const struct state *now, int i, double direction) {
    double drift = now->drift[i];
    double beyond = drift + copysign(dp_system_storey_noise(s, now, i), direction);
    s->tangent[i] = storey_at(s, now, i, beyond).tangent;
    s->base[i] = storey_at(s, now, i, drift).shear - s->tangent[i] * drift;
}

static void start_building(struct dp_system *s, const struct state *now, int k) {
    const struct building *g = &s->model->building[k];
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        const struct storey *law = &s->model->storey[i];
        s->mobility[i] = 1.0 / s->model->mass[i];
        s->stiffness[i] = s->tangent[i] = g->stiffness[i - g->first];
        s->below[i] = i > g->first ? i - 1 : -1;
        s->calls[i] = !is_straight(law);
        if (law->law->n_history > 0) {
            double rate = now->v[i] - (i > g->first ? now->v[i - 1] : 0.0);
            s->inelastic[s->n_inelastic++] = i;
            dp_system_branch(s, now, i, rate);
        }
    }
}

void dp_system_start(struct dp_system *s, const struct state *now) {
    const struct model *m = s->model;
    (void)forcing_turn(&s->forcing, now->time);
    for (int k = 0; k < m->n_building; k++) {
        start_building(s, now, k);
    }
    for (int k = 0; k < m->n_link; k++) {
        s->phase[k] = m->link[k].bilateral ? PHASE_ANY
                      : now->rate[k] < 0.0 ? PHASE_RELEASE
                                           : PHASE_APPROACH;
        if (now->closed[k]) {
            dp_system_add(s, k);
        }
    }
}

void dp_system_add(struct dp_system *s, int k) {
    s->active[s->n_active++] = k;
}

void dp_system_remove(struct dp_system *s, int k) {
    int i = 0;
    while (s->active[i] != k) {
        i++;
    }
    s->active[i] = s->active[--s->n_active];
}

struct contact_response dp_system_response(const struct dp_system *s, const struct state *now,
                                           int k, double d, double v) {
    const struct link *l = &s->model->link[k];
    const double *history = now->link_history + l->history;
    int phase = s->phase[k];
    if (phase == PHASE_ANY) {
        return l->law->force(l->constant, history, d, v);
    }
    double inside = fmax(d, 0.0);
    double seen = phase * v > 0.0 ? v : phase * DBL_MIN;
    struct contact_response r = l->law->force(l->constant, history, inside, seen);
    if (seen != v) {
        r.force += r.dfdv * v;
    }
    if (inside != d) {
        r.force += r.dfdd * d;
    }
    return r;
}

double dp_system_shear(const struct dp_system *s, const struct state *now, int i, double drift) {
    return s->calls[i] ? storey_at(s, now, i, drift).shear : s->base[i] + s->tangent[i] * drift;
}

// Restoring and damping forces of one building; the powers of its dampers and storeys.
static void building_rates(struct dp_system *s, const struct state *now, int k,
                           struct dp_rates *r) {
    const struct building *g = &s->model->building[k];
    const double *u = r->u + g->first;
    const double *v = r->v + g->first;
    double *a = r->a + g->first;
    double *damping = s->damping + g->first;
    double below = 0.0;
    double below_v = 0.0;
    double momentum = 0.0;
    building_damping_force(g, v, damping);
    for (int i = 0; i < g->n_floor; i++) {
        int j = g->first + i;
        double shear = dp_system_shear(s, now, j, u[i] - below);
        if (!g->elastic && s->model->storey[j].law->n_history > 0) {
            r->storey += shear * (v[i] - below_v);
        }
        a[i] = -damping[i] - shear;
        if (i > 0) {
            a[i - 1] += shear;
        }
        r->damping += damping[i] * v[i];
        momentum += g->mass[i] * v[i];
        below = u[i];
        below_v = v[i];
    }
    r->input -= r->ground.a[g->ground] * momentum;
}

static void load_rates(const struct dp_system *s, double t, struct dp_rates *r) {
    for (int k = 0; k < s->model->n_load; k++) {
        int i = s->model->load[k].dof;
        double p = forcing_load(&s->forcing, k, t);
        r->a[i] += p;
        r->input += p * r->v[i];
    }
}

static void link_rates(const struct dp_system *s, const struct state *now, struct dp_rates *r) {
    const struct model *m = s->model;
    for (int i = 0; i < s->n_active; i++) {
        int k = s->active[i];
        const struct link *l = &m->link[k];
        double rate = state_gap(l, m, r->v, r->ground.v);
        double d = state_gap(l, m, r->u, r->ground.u) - l->gap;
        double force = dp_system_response(s, now, k, d, rate).force;
        r->force[i] = force;
        r->power[i] = force * rate;
        if (l->dof[0] != WALL) {
            r->a[l->dof[0]] -= force;
        }
        if (l->dof[1] != WALL) {
            r->a[l->dof[1]] += force;
        }
        if (l->moving_ground) {
            r->input += force * (rate - (r->v[l->dof[0]] - r->v[l->dof[1]]));
        }
    }
}

void dp_system_rates(struct dp_system *s, const struct state *now, double t, struct dp_rates *r) {
    const struct model *m = s->model;
    forcing_ground(&s->forcing, t, &r->ground);
    r->input = r->damping = r->storey = 0.0;
    for (int k = 0; k < m->n_building; k++) {
        building_rates(s, now, k, r);
    }
    load_rates(s, t, r);
    link_rates(s, now, r);
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        double ground = r->ground.a[g->ground];
        for (int i = g->first; i < g->first + g->n_floor; i++) {
            r->a[i] = r->a[i] * s->mobility[i] - ground;
        }
    }
}

void dp_system_commit(const struct dp_system *s, struct state *now) {
    const struct model *m = s->model;
    for (int i = 0; i < s->n_inelastic; i++) {
        const struct storey *law = &m->storey[s->inelastic[i]];
        law->law->commit(law->constant, now->storey_history + law->history,
                         now->drift[s->inelastic[i]]);
    }
    for (int i = 0; i < s->n_active; i++) {
        const struct link *l = &m->link[s->active[i]];
        if (l->law->commit) {
            l->law->commit(l->constant, now->link_history + l->history,
                           fmax(now->delta[s->active[i]], 0.0), now->rate[s->active[i]]);
        }
    }
}
