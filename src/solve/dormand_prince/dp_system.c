// SPDX-License-Identifier: GPL-3.0-or-later
// A step of high order needs a smooth right-hand side. So within a step every law is held on its
// branch, and continued along it where a stage lies beyond: a contact by the tangents at its end
// (d = 0, or v = 0 from the side of its phase), which is exact for laws that are linear there, a
// storey made of straight lines by its line. Where the branch really ends the step does; see
// dp_event.c. Other storey laws are called as they are.
#include "solve/dormand_prince/dp_system.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "solve/dormand_prince/dp.h"
#include "solve/dormand_prince/dp_parts.h"

// How far beyond its drift a storey is asked for its tangent, relative to its drift or to that
// which its shear would take elastically: far above rounding, far below any tolerance.
static const double PROBE = 1e-12;
// Rounding of a drift at which the shear is 0, relative to the largest drift before it.
static const double ROUNDING = 64.0 * DBL_EPSILON;

static const struct fields_row list[] = {
    FIELD_PART(struct dp_system, forcing, forcing_fields),
    FIELD_ARRAY(struct dp_system, row[DP_K_BELOW], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_K_OWN], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_K_ABOVE], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_CONSTANT], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, base, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, tangent, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, most_drift, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, phase, FIELD_LINKS),
};
const struct fields dp_system_fields = FIELDS(list);

bool dp_system_alloc(struct dp_system *s, const struct model *m, struct arena *a) {
    size_t n = (size_t)m->n_dof;
    *s = (struct dp_system){.model = m, .floors = LANES_WIDEST_OF(&dp_wide, &dp_narrow)};
    s->mobility = lanes_array(a, m->n_dof);
    s->base = lanes_array(a, m->n_dof);
    s->tangent = lanes_array(a, m->n_dof);
    s->most_drift = lanes_array(a, m->n_dof);
    s->damping = lanes_array(a, m->n_dof);
    s->part_drift = lanes_array(a, m->n_dof);
    s->part_rate = lanes_array(a, m->n_dof);
    s->part_shear = lanes_array(a, m->n_dof);
    s->part_history = arena_alloc(a, (size_t)m->n_storey_history, sizeof(double));
    for (int q = 0; q < DP_ROWS; q++) {
        s->row[q] = lanes_array(a, m->n_dof);
    }
    s->phase = arena_alloc(a, (size_t)m->n_link, sizeof *s->phase);
    s->inelastic = arena_alloc(a, n, sizeof *s->inelastic);
    s->below = arena_alloc(a, n, sizeof *s->below);
    s->calls = arena_alloc(a, n, sizeof *s->calls);
    s->building = arena_alloc(a, n, sizeof *s->building);
    return forcing_alloc(&s->forcing, m, a);
}

static bool dp_is_straight(const struct storey *law) {
    return law->law->n_history == 0 || (law->law->traits & STOREY_STRAIGHT);
}

static struct storey_response dp_storey_at(const struct dp_system *s, const struct state *now,
                                           int i, double drift) {
    const struct storey *law = &s->model->storey[i];
    return law->law->respond(law->constant, now->storey_history + law->history, drift, NULL);
}

double dp_system_tangent(const struct dp_system *s, const struct state *now, int i, double drift) {
    return dp_storey_at(s, now, i, drift).tangent;
}

double dp_system_storey_noise(const struct dp_system *s, const struct state *now, int i) {
    double elastic = dp_storey_at(s, now, i, now->drift[i]).shear / s->model->chain.stiffness[i];
    double probe = PROBE * (fabs(now->drift[i]) + fabs(elastic));
    return fmax(probe, ROUNDING * s->most_drift[i]);
}

// The rows of the matrices that have to do with storey i: those of the floors above and below it.
static void dp_fill_rows(struct dp_system *s, int i) {
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

void dp_system_branch(struct dp_system *s, const struct state *now, int i, double from,
                      double direction) {
    if (!s->calls[i]) {
        double drift = now->drift[i];
        double beyond = from + copysign(dp_system_storey_noise(s, now, i), direction);
        s->tangent[i] = dp_storey_at(s, now, i, beyond).tangent;
        s->base[i] = dp_storey_at(s, now, i, drift).shear - s->tangent[i] * drift;
    }
    dp_fill_rows(s, i);
}

static void dp_start_floor(struct dp_system *s, const struct state *now, int k, int floor) {
    const struct building *g = &s->model->building[k];
    int i = g->first + floor;
    const struct storey *law = &s->model->storey[i];
    s->row[DP_GROUND][i] = s->model->n_ground == 1 ? 1.0 : 0.0;
    s->row[DP_CARRIED][i] = s->row[DP_GROUND][i] * g->mass[floor];
    s->mobility[i] = 1.0 / g->mass[floor];
    s->building[i] = k;
    s->below[i] = floor > 0 ? i - 1 : -1;
    s->calls[i] = !dp_is_straight(law);
    s->tangent[i] = s->calls[i] ? 0.0 : g->spring[floor];
    if (!g->damping_full) {
        s->row[DP_C_BELOW][i] = floor > 0 ? g->damping_off[floor - 1] * s->mobility[i] : 0.0;
        s->row[DP_C_OWN][i] = g->damping_diagonal[floor] * s->mobility[i];
        s->row[DP_C_ABOVE][i] = g->damping_off[floor] * s->mobility[i];
        s->row[DP_DAMPER][i] = g->damping_diagonal[floor];
        s->row[DP_DAMPER_ABOVE][i] = 2.0 * g->damping_off[floor];
    }
    if (law->law->n_history > 0) {
        s->inelastic[s->n_inelastic++] = i;
        dp_system_branch(s, now, i, now->drift[i], now->v[i] - (floor > 0 ? now->v[i - 1] : 0.0));
    }
    dp_fill_rows(s, i);
}

static enum phase dp_start_phase(const struct model *m, const struct state *now, int k) {
    const struct link *l = &m->link[k];
    if (l->bilateral && isfinite(l->law->force(l->constant, NULL, 0.0, 0.0).dfdv)) {
        return PHASE_ANY;
    }
    return state_rate(now, m, k) < 0.0 ? PHASE_RELEASE : PHASE_APPROACH;
}

void dp_system_start(struct dp_system *s, const struct state *now) {
    const struct model *m = s->model;
    (void)forcing_turn(&s->forcing, now->time);
    for (int k = 0; k < m->n_building; k++) {
        for (int i = 0; i < m->building[k].n_floor; i++) {
            dp_start_floor(s, now, k, i);
        }
    }
    s->special = m->n_ground > 1 || m->chain.full_damping || s->n_inelastic > 0 || m->n_load > 0;
    for (int k = 0; k < m->n_link; k++) {
        s->phase[k] = dp_start_phase(m, now, k);
    }
}

double dp_system_shear(const struct dp_system *s, const struct state *now, int i, double drift) {
    return s->calls[i] ? dp_storey_at(s, now, i, drift).shear : s->base[i] + s->tangent[i] * drift;
}

double dp_system_storey_lag(const struct dp_system *s, const struct state *now, int i) {
    double drift = now->drift[i];
    double missed = dp_system_shear(s, now, i, drift) - dp_storey_at(s, now, i, drift).shear;
    return fabs(missed) / s->model->chain.stiffness[i];
}

void dp_system_commit(const struct dp_system *s, struct state *now) {
    const struct model *m = s->model;
    for (int i = 0; i < s->n_inelastic; i++) {
        const struct storey *law = &m->storey[s->inelastic[i]];
        double drift = now->drift[s->inelastic[i]];
        double *history = now->storey_history + law->history;
        law->law->respond(law->constant, history, drift, history);
        s->most_drift[s->inelastic[i]] = fmax(s->most_drift[s->inelastic[i]], fabs(drift));
    }
    dp_parts_commit(s, now);
    state_commit_links(now, m);
}
