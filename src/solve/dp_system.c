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
#include "core/lanes.h"

// How far beyond its drift a storey is asked for its tangent, relative to its drift or to that
// which its shear would take elastically: far above rounding, far below any tolerance.
static const double PROBE = 1e-12;

bool dp_system_alloc(struct dp_system *s, const struct model *m, struct arena *a) {
    size_t n = (size_t)m->n_dof;
    *s = (struct dp_system){.model = m};
    double **const part[] = {&s->mobility, &s->base, &s->tangent, &s->damping};
    bool good = true;
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        good = good && (*part[i] = lanes_array(a, m->n_dof));
    }
    for (int q = 0; q < DP_ROWS; q++) {
        good = good && (s->row[q] = lanes_array(a, m->n_dof));
    }
    s->phase = arena_alloc(a, (size_t)m->n_link, sizeof *s->phase);
    s->inelastic = arena_alloc(a, n, sizeof *s->inelastic);
    s->below = arena_alloc(a, n, sizeof *s->below);
    s->calls = arena_alloc(a, n, sizeof *s->calls);
    s->building = arena_alloc(a, n, sizeof *s->building);
    return good && s->phase && s->inelastic && s->below && s->calls && s->building &&
           forcing_alloc(&s->forcing, m, a);
}

bool dp_system_alloc_rates(struct dp_rates *r, const struct model *m, struct arena *a) {
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
    return r->u && r->v && r->a && r->force && r->power && r->dfdd && r->dfdv && r->ground.a &&
           r->ground.v && r->ground.u;
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
    double elastic = storey_at(s, now, i, now->drift[i]).shear / s->model->chain.stiffness[i];
    return PROBE * (fabs(now->drift[i]) + fabs(elastic));
}

// The rows of the matrices that have to do with storey i: those of the floors above and below it.
static void fill_rows(struct dp_system *s, int i) {
    const struct building *g = &s->model->building[s->building[i]];
    for (int j = i > g->first ? i - 1 : i; j <= i; j++) {
        bool roof = j + 1 == g->first + g->n_floor;
        double above = roof ? 0.0 : s->tangent[j + 1];
        s->row[DP_K_BELOW][j] = j > g->first ? -s->tangent[j] * s->mobility[j] : 0.0;
        s->row[DP_K_OWN][j] = (s->tangent[j] + above) * s->mobility[j];
        s->row[DP_K_ABOVE][j] = -above * s->mobility[j];
        s->row[DP_CONSTANT][j] = ((roof ? 0.0 : s->base[j + 1]) - s->base[j]) * s->mobility[j];
    }
}

void dp_system_branch(struct dp_system *s, const struct state *now, int i, double direction) {
    if (!s->calls[i]) {
        double drift = now->drift[i];
        double beyond = drift + copysign(dp_system_storey_noise(s, now, i), direction);
        s->tangent[i] = storey_at(s, now, i, beyond).tangent;
        s->base[i] = storey_at(s, now, i, drift).shear - s->tangent[i] * drift;
    }
    fill_rows(s, i);
}

static void start_floor(struct dp_system *s, const struct state *now, int k, int floor) {
    const struct building *g = &s->model->building[k];
    int i = g->first + floor;
    const struct storey *law = &s->model->storey[i];
    s->row[DP_GROUND][i] = s->model->n_ground == 1 ? 1.0 : 0.0;
    s->row[DP_CARRIED][i] = s->row[DP_GROUND][i] * g->mass[floor];
    s->mobility[i] = 1.0 / g->mass[floor];
    s->building[i] = k;
    s->below[i] = floor > 0 ? i - 1 : -1;
    s->calls[i] = !is_straight(law);
    s->tangent[i] = s->calls[i] ? 0.0 : g->stiffness[floor];
    if (!g->damping_full) {
        s->row[DP_C_BELOW][i] = floor > 0 ? g->damping_off[floor - 1] * s->mobility[i] : 0.0;
        s->row[DP_C_OWN][i] = g->damping_diagonal[floor] * s->mobility[i];
        s->row[DP_C_ABOVE][i] = g->damping_off[floor] * s->mobility[i];
        s->row[DP_DAMPER][i] = g->damping_diagonal[floor];
        s->row[DP_DAMPER_ABOVE][i] = 2.0 * g->damping_off[floor];
    }
    if (law->law->n_history > 0) {
        s->inelastic[s->n_inelastic++] = i;
        dp_system_branch(s, now, i, now->v[i] - (floor > 0 ? now->v[i - 1] : 0.0));
    }
    fill_rows(s, i);
}

void dp_system_start(struct dp_system *s, const struct state *now) {
    const struct model *m = s->model;
    (void)forcing_turn(&s->forcing, now->time);
    for (int k = 0; k < m->n_building; k++) {
        for (int i = 0; i < m->building[k].n_floor; i++) {
            start_floor(s, now, k, i);
        }
    }
    s->special = m->n_ground > 1 || m->chain.full_damping || s->n_inelastic > 0 || m->n_load > 0;
    for (int k = 0; k < m->n_link; k++) {
        s->phase[k] = m->link[k].bilateral          ? PHASE_ANY
                      : state_rate(now, m, k) < 0.0 ? PHASE_RELEASE
                                                    : PHASE_APPROACH;
    }
}

static inline struct contact_response
response_of(const struct dp_system *s, const struct state *now, int k, double d, double v) {
    const struct link *l = &s->model->link[k];
    const double *history = now->link_history + l->history;
    int phase = s->phase[k];
    if (phase == PHASE_ANY) {
        return l->law->force(l->constant, history, d, v);
    }
    double inside = d > 0.0 ? d : 0.0;
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

struct contact_response dp_system_response(const struct dp_system *s, const struct state *now,
                                           int k, double d, double v) {
    return response_of(s, now, k, d, v);
}

double dp_system_shear(const struct dp_system *s, const struct state *now, int i, double drift) {
    return s->calls[i] ? storey_at(s, now, i, drift).shear : s->base[i] + s->tangent[i] * drift;
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
        struct contact_response response = response_of(s, now, k, d, rate);
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

void dp_system_add(const struct dp_system *s, const struct state *now, double t,
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

void dp_system_rates(const struct dp_system *s, const struct state *now, double t,
                     struct dp_rates *r) {
    floor_rates(s, dp_system_ground(s, t, r), r);
    dp_system_add(s, now, t, r);
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

double dp_system_acceleration(const struct dp_system *s, const struct state *now, double t,
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

void dp_system_commit(const struct dp_system *s, struct state *now) {
    const struct model *m = s->model;
    for (int i = 0; i < s->n_inelastic; i++) {
        const struct storey *law = &m->storey[s->inelastic[i]];
        law->law->commit(law->constant, now->storey_history + law->history,
                         now->drift[s->inelastic[i]]);
    }
    for (int i = 0; i < now->n_live; i++) {
        int k = now->live[i];
        const struct link *l = &m->link[k];
        if (l->law->commit) {
            l->law->commit(l->constant, now->link_history + l->history, fmax(now->delta[k], 0.0),
                           state_rate(now, m, k));
        }
    }
}
