// SPDX-License-Identifier: GPL-3.0-or-later
// M a = -M a_g + p - C v - storey shears - link forces, building by building, without a matrix of
// the whole: what the linear floors (dp_floors.h) leave out. And the dense output: the motion
// within a step.
#include <math.h>
#include <string.h>

#include "core/root.h"
#include "model/parts.h"
#include "solve/dormand_prince/dp.h"

static const double PRECISION = 1e-9;  // of x; the next correction would be about its square

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
    FIELD_ARRAY(struct dp_rates, power, FIELD_FLOORS),
};
const struct fields dp_rates_fields = FIELDS(list);

const double *dp_rates_parts(const struct dp *p, const struct building *g, const double *history,
                             const double *u, const double *v, double *after) {
    const struct dp_system *s = &p->system;
    double *shear = s->part_shear + g->first;
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        s->part_drift[i] = u[i] - u[s->below[i]];
        s->part_rate[i] = v[i] - v[s->below[i]];
    }
    memset(shear, 0, (size_t)g->n_dof * sizeof *shear);
    parts_respond(g, history, s->part_drift + g->first, s->part_rate + g->first,
                  &(struct part_sums){.shear = shear, .scratch = s->part_scratch}, after);
    return shear;
}

// The power of parts and of elastic storeys beside them; that of other storeys is taken with them.
static void dp_part_rates(const struct dp *p, const struct building *g, struct dp_rates *r) {
    const struct dp_system *s = &p->system;
    const double *shear = dp_rates_parts(p, g, p->now.storey_history, r->u, r->v, NULL);
    double power = 0.0;
    for (int floor = 0; floor < g->n_dof; floor++) {
        const int i = g->first + floor;
        const double above = floor + 1 < g->n_dof ? shear[floor + 1] : 0.0;
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
    r->power[i] = shear * (r->v[i] - r->v[below]);
    r->storey += r->power[i];
    if (s->calls[i]) {
        r->a[i] -= shear * s->mobility[i];
    }
    if (s->calls[i] && below >= 0) {
        r->a[below] += shear * s->mobility[below];
    }
}

// What the vectors do not know of a building: one of several grounds, a full damping matrix, parts,
// storeys with a history.
static void dp_building_rates(const struct dp *p, const struct building *g, struct dp_rates *r) {
    const struct dp_system *s = &p->system;
    const int end = g->first + g->n_dof;
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

// Adds what the force of a link does to the accelerations.
static void dp_push_link(const struct dp_system *s, const struct link *l, double force, double *a) {
    for (int side = 0; side < 2; side++) {
        const double push = side == 0 ? -force : force;
        for (int j = 0, n = link_entries(l, side); j < n; j++) {
            const struct link_entry e = link_entry(l, side, j);
            a[e.dof] += e.weight * push * s->mobility[e.dof];
        }
    }
}

void dp_rates_creeping(const struct dp *p, int i, double d, double v, struct dp_link_rates *r) {
    const struct link *l = &p->model->link[p->now.live[i]];
    const double history[] = {0.0, r->creep, 0.0};
    r->response = l->law->force(l->constant, history, d, v);
    r->flow = l->law->creep(l->constant, r->response.force);
}

double dp_rates_creep(const struct dp *p, int i, double x) {
    const struct dp_link_rates *first = &p->stage[0]->link[i];
    const struct dp_link_rates *last = &p->stage[DP_STAGES - 1]->link[i];
    const double rise = last->creep - first->creep;
    const double start = p->h * first->flow, end = p->h * last->flow;
    const double bend = 3.0 * rise - 2.0 * start - end, turn = start + end - 2.0 * rise;
    return first->creep + x * (start + x * (bend + x * turn));
}

// Link number i of the live ones.
static void dp_link_rates(const struct dp *p, int i, struct dp_rates *r) {
    const struct model *m = p->model;
    const int k = p->now.live[i];
    const struct link *l = &m->link[k];
    const double d = dp_system_across(l, m, r->u, r->ground.u) - l->gap;
    const double rate = dp_system_across(l, m, r->v, r->ground.v);
    struct dp_link_rates *own = &r->link[i];
    if (p->system.creeps && l->law->creep) {
        own->creep = p->h == 0.0 ? p->now.link_history[l->history + 1] : own->creep;
        dp_rates_creeping(p, i, d, rate, own);
    } else {
        own->response = dp_system_response(p, k, d, rate);
        own->flow = 0.0;
    }
    const double force = own->response.force;
    own->power = force * rate;
    dp_push_link(&p->system, l, force, r->a);
    r->input += force * state_ground_gap(l, m, r->ground.v);
}

void dp_rates_add(const struct dp *p, double t, int building, struct dp_rates *r) {
    const struct model *m = p->model;
    const bool all = building == DP_ALL;
    const int first = all ? 0 : building, end = all ? m->n_body : building + 1;
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
                             lanes_whole(g->first + g->n_dof)};
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
    for (int n = 0; p->system.creeps && n < p->now.n_live; n++) {
        p->stage[1]->link[n].creep = dp_rates_creep(p, n, x);
    }
    dp_rates_at(p, p->now.time + x * p->h, building, p->stage[1]);
}

static double dp_motion_at(double x, void *context, double *slope) {
    *slope = dp_motion_slope(context, x);
    return dp_motion_value(context, x);
}

double dp_motion_root(struct polynomial p, double low, double high) {
    double start = dp_motion_value(&p, low);
    double end = dp_motion_value(&p, high);
    if (start == 0.0 || start == end) {
        return low;
    }
    const struct root r = {low, high, end > start ? 1.0 : -1.0};
    return root_newton(dp_motion_at, &p, r, root_between(&r, start, end), PRECISION);
}

struct polynomial dp_motion_velocity(const struct motion *m) {
    double c1 = m->h * m->a[0];
    double end = m->h * m->a[1];
    double rise = m->v[1] - m->v[0];
    return (struct polynomial){
        {m->v[0], c1, 3.0 * rise - 2.0 * c1 - end, c1 + end - 2.0 * rise, 0.0, 0.0}};
}
int dp_motion_extrema(const struct polynomial *p, double *at) {
    double a = 3.0 * p->c[3];
    double b = p->c[2];  // a x^2 + 2 b x + c
    double c = p->c[1];
    bool same_sign = c * (a + 2.0 * b + c) > 0.0;
    if (same_sign && b * (a + b) >= 0.0) {
        return 0;  // it is monotone between ends of one sign
    }
    double square = b * b - a * c;
    if (!(square > 0.0)) {
        return 0;
    }
    double q = -(b + copysign(sqrt(square), b));
    double root[2] = {q / a, c / q};
    if (!(root[0] <= root[1])) {
        double first = root[1];
        root[1] = root[0];
        root[0] = first;
    }
    int n = 0;
    for (int i = 0; i < 2; i++) {
        if (root[i] > 0.0 && root[i] < 1.0) {
            at[n++] = root[i];
        }
    }
    return n;
}

// Instants 0 < x < 1 at which the velocity changes its sign, ascending; returns how many.
static int dp_motion_turns(const struct motion *m, double *at) {
    bool same_sign = m->v[0] * m->v[1] > 0.0;
    if (same_sign && m->v[0] * m->a[0] >= 0.0 && m->v[1] * m->a[1] <= 0.0) {
        return 0;  // no cubic with these ends comes back to zero
    }
    struct polynomial v = dp_motion_velocity(m);
    double end[TURNS_MAX + 1];
    int n_end = dp_motion_extrema(&v, end);
    end[n_end++] = 1.0;
    int n = 0;
    double low = 0.0;
    for (int i = 0; i < n_end; i++) {
        if (dp_motion_value(&v, low) * dp_motion_value(&v, end[i]) < 0.0) {
            double x = dp_motion_root(v, low, end[i]);
            if (x > 0.0 && x < 1.0) {
                at[n++] = x;
            }
        }
        low = end[i];
    }
    return n;
}

struct motion_pieces dp_motion_cut(const struct motion *m) {
    struct motion_pieces s = {.path = dp_motion_path(m), .n = 1};
    s.n += dp_motion_turns(m, s.x + 1);
    s.x[0] = 0.0;
    s.x[s.n] = 1.0;
    s.d[0] = m->d[0];
    s.d[s.n] = m->d[1];
    for (int i = 1; i < s.n; i++) {
        s.d[i] = dp_motion_value(&s.path, s.x[i]);
    }
    return s;
}

struct motion dp_motion_link(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    return (struct motion){
        .d = {p->now.delta[k], p->next.delta[k]},
        .v = {p->rate[0][k], p->rate[1][k]},
        .a = {dp_system_across(l, p->model, p->now.a, p->now.ground_a),
              dp_system_across(l, p->model, p->next.a, p->next.ground_a)},
        .h = p->h,
    };
}

// The ground is the zero in front of the arrays.
struct motion dp_motion_floor(const struct dp *p, int i, int below) {
    const struct state *now = &p->now, *next = &p->next;
    return (struct motion){
        .d = {now->u[i] - now->u[below], next->u[i] - next->u[below]},
        .v = {now->v[i] - now->v[below], next->v[i] - next->v[below]},
        .a = {now->a[i] - now->a[below], next->a[i] - next->a[below]},
        .h = p->h,
    };
}

double dp_motion_noise(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    double size = fabs(l->gap) + p->scales.most_u;  // bodies at rest move by rounding
    for (int i = 0; i < 2; i++) {
        size += fmax(link_size_at(l, i, p->now.u), link_size_at(l, i, p->next.u));
        if (l->moving_ground) {
            size += fabs(p->now.ground_u[p->model->building[l->building[i]].ground]);
        }
    }
    return SCALE_ROUNDING * size;
}

// A motion that goes beyond both its ends does so by a fraction of its way at the larger rate.
LANES void dp_motion_reach(struct dp *p) {
    const double *restrict d0 = p->now.delta, *restrict d1 = p->next.delta;
    const double *restrict v0 = p->rate[0], *restrict v1 = p->rate[1];
    const double *restrict deepest = p->results->deepest;
    double *restrict reach = p->reach;
    double h = p->h;
    int64_t closes = 0;
    int64_t deepens = 0;
    for (int i = 0, n = p->model->n_contact; i < n; i++) {
        double d = d0[i] > d1[i] ? d0[i] : d1[i];
        double v = fabs(v0[i]) > fabs(v1[i]) ? fabs(v0[i]) : fabs(v1[i]);
        double most = d + h * v;
        reach[i] = most;
        closes |= most > 0.0;
        deepens |= most > deepest[i];
    }
    p->closes = closes != 0;
    p->deepens = deepens != 0;
}
