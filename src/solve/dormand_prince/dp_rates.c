// SPDX-License-Identifier: GPL-3.0-or-later
// M a = -M a_g + p - C v - storey shears - link forces, building by building, without a matrix of
// the whole: what the linear floors (dp_floors.h) leave out.
#include <math.h>
#include <string.h>

#include "model/parts.h"
#include "solve/dormand_prince/dp.h"

static const struct fields_row list[] = {
    FIELD_ARRAY(struct dp_rates, u, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, v, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, a, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, ground.a, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, ground.v, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, ground.u, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, link, FIELD_LINKS),
    FIELD_VALUE(struct dp_rates, input),
    FIELD_VALUE(struct dp_rates, damping),
    FIELD_VALUE(struct dp_rates, storey),
};
const struct fields dp_rates_fields = FIELDS(list);

const double *dp_rates_parts(const struct dp *p, const struct building *g, const double *history,
                             const double *u, const double *v, double *after) {
    const struct dp_system *s = &p->system;
    double *shear = s->part_shear + g->first;
    for (int i = g->first; i < g->first + g->n_floor; i++) {
        s->part_drift[i] = u[i] - u[s->below[i]];
        s->part_rate[i] = v[i] - v[s->below[i]];
    }
    memset(shear, 0, (size_t)g->n_floor * sizeof *shear);
    parts_respond(g, history, s->part_drift + g->first, s->part_rate + g->first,
                  &(struct part_sums){.shear = shear}, after);
    return shear;
}

// A storey's shear: on the floor above it and the one below.
static void dp_push_storey(const struct dp_system *s, int i, double shear, struct dp_rates *r) {
    r->a[i] -= shear * s->mobility[i];
    if (s->below[i] >= 0) {
        r->a[s->below[i]] += shear * s->mobility[s->below[i]];
    }
}

// The power of parts and of elastic storeys beside them; that of other storeys is taken with them.
static void dp_part_rates(const struct dp *p, const struct building *g, struct dp_rates *r) {
    const struct dp_system *s = &p->system;
    const double *shear = dp_rates_parts(p, g, p->now.storey_history, r->u, r->v, NULL);
    double power = 0.0;
    for (int floor = 0; floor < g->n_floor; floor++) {
        const int i = g->first + floor;
        const double above = floor + 1 < g->n_floor ? shear[floor + 1] : 0.0;
        const double spring = p->model->storey[i].law->n_history == 0 ? g->spring[floor] : 0.0;
        r->a[i] += (above - shear[floor]) * s->mobility[i];
        power += (shear[floor] + spring * s->part_drift[i]) * s->part_rate[i];
    }
    r->storey += g->elastic ? 0.0 : power;
}

// A storey with a history: its power, and its shear if the law is called.
static void dp_storey_rates(const struct dp *p, int i, struct dp_rates *r) {
    const struct dp_system *s = &p->system;
    const int below = s->below[i];
    const double shear = dp_system_shear(p, i, r->u[i] - r->u[below]);
    r->storey += shear * (r->v[i] - r->v[below]);
    if (s->calls[i]) {
        dp_push_storey(s, i, shear, r);
    }
}

// What the vectors do not know of a building: one of several grounds, a full damping matrix, parts,
// storeys with a history.
static void dp_building_rates(const struct dp *p, const struct building *g, struct dp_rates *r) {
    const struct dp_system *s = &p->system;
    const int end = g->first + g->n_floor;
    const double ground = r->ground.a[g->ground];
    for (int i = g->first; p->model->n_ground > 1 && i < end; i++) {
        r->a[i] -= ground;
        r->input -= ground * p->model->mass[i] * r->v[i];
    }
    if (g->damping_full) {
        building_damping_force(g, r->v + g->first, s->damping + g->first);
    }
    for (int i = g->first; g->damping_full && i < end; i++) {
        r->a[i] -= s->damping[i] * s->mobility[i];
        r->damping += s->damping[i] * r->v[i];
    }
    if (g->n_part > 0) {
        dp_part_rates(p, g, r);
    }
    for (int i = g->first; s->n_inelastic > 0 && i < end; i++) {
        if (p->model->storey[i].law->n_history > 0) {
            dp_storey_rates(p, i, r);
        }
    }
}

static void dp_load_rates(const struct dp *p, double t, int k, struct dp_rates *r) {
    const int i = p->model->load[k].dof;
    const double load = forcing_load(&p->system.forcing, k, t);
    r->a[i] += load * p->system.mobility[i];
    r->input += load * r->v[i];
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

static void dp_push_link(const struct dp_system *s, const struct link *l, double force, double *a) {
    if (!link_is_plain(l)) {
        dp_push_rows(s, l, force, a);
        return;
    }
    if (l->dof[0] != WALL) {
        a[l->dof[0]] -= force * s->mobility[l->dof[0]];
    }
    if (l->dof[1] != WALL) {
        a[l->dof[1]] += force * s->mobility[l->dof[1]];
    }
}

// Link number i of the live ones.
static void dp_link_rates(const struct dp *p, int i, struct dp_rates *r) {
    const struct model *m = p->model;
    const int k = p->now.live[i];
    const struct link *l = &m->link[k];
    const double d = dp_system_across(l, m, r->u, r->ground.u) - l->gap;
    const double rate = dp_system_across(l, m, r->v, r->ground.v);
    const struct contact_response response = dp_system_response(p, k, d, rate);
    dp_push_link(&p->system, l, response.force, r->a);
    r->input += response.force * state_ground_gap(l, m, r->ground.v);
    r->link[i] = (struct dp_link_rates){response, response.force * rate};
}

void dp_rates_add(const struct dp *p, double t, int building, struct dp_rates *r) {
    const struct model *m = p->model;
    const bool all = building == DP_ALL;
    const int first = all ? 0 : building, end = all ? m->n_building : building + 1;
    r->input = r->damping = r->storey = 0.0;
    for (int k = first; p->system.special && k < end; k++) {
        dp_building_rates(p, &m->building[k], r);
    }
    for (int k = 0; k < m->n_load; k++) {
        if (all || p->system.building[m->load[k].dof] == building) {
            dp_load_rates(p, t, k, r);
        }
    }
    for (int i = 0; i < p->now.n_live; i++) {
        const int *of = m->link[p->now.live[i]].building;
        if (all || of[0] == building || of[1] == building) {
            dp_link_rates(p, i, r);
        }
    }
}

// The floors of a building, or of all, in whole lanes: from the first up to the second.
struct dp_range {
    int first, end;
};
static struct dp_range dp_range(const struct model *m, int building) {
    if (building == DP_ALL) {
        return (struct dp_range){0, lanes_whole(m->n_dof)};
    }
    const struct building *g = &m->building[building];
    return (struct dp_range){lanes_whole(g->first + 1) - LANES_WIDTH,
                             lanes_whole(g->first + g->n_floor)};
}

void dp_rates_at(const struct dp *p, double t, int building, struct dp_rates *r) {
    const struct dp_range range = dp_range(p->model, building);
    p->floors->rates(p, dp_rates_ground(p, t, r), range.first, range.end, r);
    if (p->system.special || p->now.n_live > 0) {
        dp_rates_add(p, t, building, r);
    }
}

// The floors from `first` up to `end` at place x of a step of h.
LANES static void dp_interpolate(const struct state *now, const struct state *next, double h,
                                 double x, const struct dp_range *range, double *restrict u,
                                 double *restrict v) {
    for (int i = range->first; i < range->end; i++) {
        const struct motion m = {.d = {now->u[i], next->u[i]},
                                 .v = {now->v[i], next->v[i]},
                                 .a = {now->a[i], next->a[i]},
                                 .h = h};
        const struct polynomial path = dp_motion_path(&m);
        u[i] = dp_motion_value(&path, x);
        v[i] = dp_motion_slope(&path, x) / h;
    }
}

void dp_rates_move(const struct dp *p, double x, int building) {
    const struct dp_range range = dp_range(p->model, building);
    dp_interpolate(&p->now, &p->next, p->h, x, &range, p->stage[1]->u, p->stage[1]->v);
}

void dp_rates_within(struct dp *p, double x, int building) {
    dp_rates_move(p, x, building);
    for (int n = 0; n < p->now.n_live && building != DP_ALL; n++) {
        const int *of = p->model->link[p->now.live[n]].building;
        const int other = of[0] == building ? of[1] : of[0];
        if ((of[0] == building || of[1] == building) && other != WALL) {
            dp_rates_move(p, x, other);
        }
    }
    dp_rates_at(p, p->now.time + x * p->h, building, p->stage[1]);
}
