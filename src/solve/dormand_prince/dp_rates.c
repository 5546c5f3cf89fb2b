// SPDX-License-Identifier: GPL-3.0-or-later
// The right-hand side of the equations of motion on the present branches of the laws,
//     M a = -M a_g + p - C v - storey shears - link forces,
// building by building, without a matrix of the whole: what the linear floors (dp_floors.h) leave
// out.
//
// A step of high order needs a smooth right-hand side. So within a step every law is held on its
// branch, and continued along it where a stage lies beyond: a contact by the tangents at its end
// (d = 0, or v = 0 from the side of its phase), which is exact for laws that are linear there, a
// storey made of straight lines by its line. Where the branch really ends the step does; see
// dp_events.c. Other storey laws are called as they are, and so are parts: their kinks and turns
// are left to the error control.
#include <math.h>
#include <string.h>

#include "model/parts.h"
#include "model/storey_force.h"
#include "solve/dormand_prince/dp.h"

// How far beyond its drift a storey is asked for its tangent, relative to its drift or to that
// which its shear would take elastically: far above rounding, far below any tolerance.
static const double PROBE = 1e-12;
// Rounding of a drift at which the shear is 0, relative to the largest drift before it.
static const double ROUNDING = 64.0 * DBL_EPSILON;

static const struct fields_row system_list[] = {
    FIELD_PART(struct dp_system, forcing, forcing_fields),
    FIELD_ARRAYS(struct dp_system, row, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, base, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, tangent, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, most_drift, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, phase, FIELD_LINKS),
    // The rest stays as it is at the start, or is scratch.
    FIELD_ARRAY(struct dp_system, mobility, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, inelastic, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, building, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, calls, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, drift, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, rate, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, force, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, part_history, FIELD_STOREY_HISTORIES),
    FIELD_ARRAY(struct dp_system, part_scratch, FIELD_PART_SCRATCH),
};
const struct fields dp_system_fields = FIELDS(system_list);

static const struct fields_row rates_list[] = {
    FIELD_ARRAY(struct dp_rates, u, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, v, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, a, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_rates, ground.a, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, ground.v, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, ground.u, FIELD_GROUNDS),
    FIELD_ARRAY(struct dp_rates, link, FIELD_LINKS),
    FIELD_VALUES(struct dp_rates, input, storey),
    FIELD_ARRAY(struct dp_rates, power, FIELD_FLOORS),
};
const struct fields dp_rates_fields = FIELDS(rates_list);

struct storey_response dp_rates_storey(const struct dp *p, int i, double drift) {
    return storey_respond(&p->model->storey[i], p->now.storey_history, drift, NULL);
}

double dp_rates_shear(const struct dp *p, int i, double drift) {
    const struct dp_system *s = &p->system;
    return s->calls[i] ? dp_rates_storey(p, i, drift).shear : s->base[i] + s->tangent[i] * drift;
}

double dp_rates_stiffness(const struct dp *p, int i) {
    return p->model->chain.stiffness[i] + p->model->storey[i].pdelta;
}

double dp_rates_noise(const struct dp *p, int i) {
    const double drift = p->now.drift[i];
    const double elastic = dp_rates_storey(p, i, drift).shear / dp_rates_stiffness(p, i);
    const double probe = PROBE * (fabs(drift) + fabs(elastic));
    return fmax(probe, ROUNDING * p->system.most_drift[i]);
}

// The rows of the matrices that have to do with storey i: those of the floors above and below it.
static void dp_fill_rows(struct dp *p, int i) {
    struct dp_system *s = &p->system;
    const struct building *g = &p->model->building[s->building[i]];
    for (int j = i > g->first ? i - 1 : i; j <= i; j++) {
        const bool roof = j + 1 == g->first + g->n_dof;
        const double above = roof ? 0.0 : s->tangent[j + 1];
        s->row[DP_K_BELOW][j] = j > g->first ? -s->tangent[j] * s->mobility[j] : 0.0;
        s->row[DP_K_OWN][j] = (s->tangent[j] + above) * s->mobility[j];
        s->row[DP_K_ABOVE][j] = -above * s->mobility[j];
        s->row[DP_CONSTANT][j] = ((roof ? 0.0 : s->base[j + 1]) - s->base[j]) * s->mobility[j];
    }
}

void dp_rates_branch(struct dp *p, int i, double from, double direction) {
    struct dp_system *s = &p->system;
    if (!s->calls[i]) {
        const double drift = p->now.drift[i];
        const double beyond = from + copysign(dp_rates_noise(p, i), direction);
        s->tangent[i] = dp_rates_storey(p, i, beyond).tangent;
        s->base[i] = dp_rates_storey(p, i, drift).shear - s->tangent[i] * drift;
    }
    dp_fill_rows(p, i);
}

static void dp_start_floor(struct dp *p, int k, int floor) {
    struct dp_system *s = &p->system;
    const struct building *g = &p->model->building[k];
    const int i = g->first + floor;
    const struct storey_law *law = p->model->storey[i].law;
    s->row[DP_GROUND][i] = p->model->n_ground == 1 ? 1.0 : 0.0;
    s->row[DP_CARRIED][i] = s->row[DP_GROUND][i] * g->mass[floor];
    s->mobility[i] = 1.0 / g->mass[floor];
    s->building[i] = k;
    s->calls[i] = law->n_history > 0 && !(law->traits & STOREY_STRAIGHT);
    s->tangent[i] = s->calls[i] ? 0.0 : g->spring[floor];
    if (!g->damping_full) {
        s->row[DP_C_BELOW][i] = floor > 0 ? g->damping_off[floor - 1] * s->mobility[i] : 0.0;
        s->row[DP_C_OWN][i] = g->damping_diagonal[floor] * s->mobility[i];
        s->row[DP_C_ABOVE][i] = g->damping_off[floor] * s->mobility[i];
        s->row[DP_DAMPER][i] = g->damping_diagonal[floor];
        s->row[DP_DAMPER_ABOVE][i] = 2.0 * g->damping_off[floor];
    }
    if (law->n_history > 0) {
        s->inelastic[s->n_inelastic++] = i;
        dp_rates_branch(p, i, p->now.drift[i], dp_drift(p, 0, i, p->now.v));
    }
    dp_fill_rows(p, i);
}

static enum phase dp_start_phase(const struct dp *p, int k) {
    const struct link *l = &p->model->link[k];
    if (l->bilateral && !(l->law->traits & CONTACT_TURNS) &&
        !bilateral_is_steep(l->law, l->constant)) {
        return PHASE_ANY;
    }
    return state_rate(&p->now, p->model, k) < 0.0 ? PHASE_RELEASE : PHASE_APPROACH;
}

void dp_rates_start(struct dp *p) {
    const struct model *m = p->model;
    struct dp_system *s = &p->system;
    (void)forcing_turn(&s->forcing, p->now.time);
    for (int k = 0; k < m->n_body; k++) {
        for (int i = 0; i < m->building[k].n_dof; i++) {
            dp_start_floor(p, k, i);
        }
    }
    s->special = m->n_ground > 1 || m->chain.full_damping || m->chain.parts || s->n_inelastic > 0 ||
                 m->n_load > 0;
    for (int k = 0; k < m->n_link; k++) {
        s->phase[k] = dp_start_phase(p, k);
        s->creeps |= m->link[k].law->creep != NULL;
    }
}

void dp_rates_commit(struct dp *p) {
    const struct model *m = p->model;
    struct dp_system *s = &p->system;
    struct state *now = &p->now;
    for (int n = 0; n < s->n_inelastic; n++) {
        const int i = s->inelastic[n];
        storey_respond(&m->storey[i], now->storey_history, now->drift[i], now->storey_history);
        s->most_drift[i] = fmax(s->most_drift[i], fabs(now->drift[i]));
    }
    for (int k = 0; k < m->n_body && !m->elastic; k++) {
        const struct building *g = &m->building[k];
        if (!g->elastic && g->n_part > 0) {
            dp_rates_parts(p, g, s->part_history, now->u, now->v, now->storey_history);
        }
    }
    for (int i = 0; s->creeps && i < now->n_live; i++) {
        const struct link *l = &m->link[now->live[i]];
        if (l->law->creep) {
            now->link_history[l->history + 1] = p->stage[0].link[i].creep;
        }
    }
    state_commit_links(now, m);
}

const double *dp_rates_parts(const struct dp *p, const struct building *g, const double *history,
                             const double *u, const double *v, double *after) {
    const struct dp_system *s = &p->system;
    double *shear = s->force + g->first;
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        s->drift[i] = dp_drift(p, 0, i, u);
        s->rate[i] = dp_drift(p, 0, i, v);
    }
    memset(shear, 0, (size_t)g->n_dof * sizeof *shear);
    parts_respond(g, history, s->drift + g->first, s->rate + g->first,
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
        power += (shear[floor] + spring * s->drift[i]) * s->rate[i];
    }
    r->storey += g->elastic ? 0.0 : power;
}

// A storey with a history: its power, and its shear if the law is called.
static void dp_storey_rates(const struct dp *p, int i, struct dp_rates *r) {
    const struct dp_system *s = &p->system;
    const double shear = dp_rates_shear(p, i, dp_drift(p, 0, i, r->u));
    r->power[i] = shear * dp_drift(p, 0, i, r->v);
    r->storey += r->power[i];
    if (s->calls[i]) {
        r->a[i] -= shear * s->mobility[i];
    }
    if (s->calls[i] && p->model->chain.joint[i] != 0.0) {
        r->a[i - 1] += shear * s->mobility[i - 1];
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
        building_damping_force(g, r->v + g->first, s->force + g->first);
    }
    for (int i = g->first; g->damping_full && i < end; i++) {
        r->a[i] -= s->force[i] * s->mobility[i];
        r->damping += s->force[i] * r->v[i];
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

// The force k d + f(v) of a damper whose slope has no bound at v = 0, with f(w) v / w in place of
// f(v), w^2 = v^2 + s^2. The velocity s is that by which steps may be wrong. Without it steps
// become shorter and shorter where the ends of such a damper move alike: the rate at which they
// come to do so is f(v) / (m v).
struct contact_response dp_rates_steep(const struct dp *p, const struct link *l, double d,
                                       double v) {
    const double *history = p->now.link_history + l->history;
    const double least = p->model->control.tolerance * p->scales.most_v;
    const double w = hypot(v, least), share = w > 0.0 ? v / w : 0.0;
    struct contact_response r = l->law->force(l->constant, history, d, w);
    const double spring = r.dfdd * d, damper = r.force - spring;
    r.force = spring + damper * share;
    r.dfdv = w > 0.0 ? share * share * r.dfdv + (1.0 - share * share) * damper / w : r.dfdv;
    return r;
}

double dp_rates_creep(const struct dp *p, int i, double x) {
    const struct dp_link_rates *first = &p->stage[0].link[i], *last = &p->stage[DP_LAST].link[i];
    const struct polynomial creep =
        hermite_cubic(first->creep, p->h * first->flow, last->creep, p->h * last->flow);
    return hermite_value(&creep, x);
}

// Adds what link number i of the live ones does to the accelerations and to the power.
static void dp_add_link(const struct dp *p, int i, struct dp_rates *r) {
    const struct model *m = p->model;
    const struct link *l = &m->link[p->now.live[i]];
    const double d = state_gap(l, m, r->u, r->ground.u) - l->gap;
    const double rate = state_gap(l, m, r->v, r->ground.v);
    struct dp_link_rates *own = &r->link[i];
    if (l->law->creep && p->h == 0.0) {
        own->creep = p->now.link_history[l->history + 1];
    }
    dp_rates_link(p, i, d, rate, own);
    const double force = own->response.force;
    own->power = force * rate;
    r->input += force * state_ground_gap(l, m, r->ground.v);
    for (int side = 0; side < 2; side++) {
        const double push = side == 0 ? -force : force;
        for (int j = 0, n = link_entries(l, side); j < n; j++) {
            const struct link_entry e = link_entry(l, side, j);
            r->a[e.dof] += e.weight * push * p->system.mobility[e.dof];
        }
    }
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
            dp_add_link(p, i, r);
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
        const struct polynomial path = hermite_path(&m);
        u[i] = hermite_value(&path, x);
        v[i] = hermite_slope(&path, x) / h;
    }
}

void dp_rates_move(const struct dp *p, double x, int building) {
    const struct dp_range range = dp_range(p->model, building);
    dp_interpolate(&p->now, &p->next, p->h, x, &range, p->stage[1].u, p->stage[1].v);
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
        p->stage[1].link[n].creep = dp_rates_creep(p, n, x);
    }
    dp_rates_at(p, p->now.time + x * p->h, building, &p->stage[1]);
}
