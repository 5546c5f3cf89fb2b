// SPDX-License-Identifier: GPL-3.0-or-later
// A step of high order needs a smooth right-hand side. So within a step every law is held on its
// branch, and continued along it where a stage lies beyond: a contact by the tangents at its end
// (d = 0, or v = 0 from the side of its phase), which is exact for laws that are linear there, a
// storey made of straight lines by its line. Where the branch really ends the step does; see
// dp_events.c. Other storey laws are called as they are, and so are parts: their kinks and turns
// are left to the error control.
#include <math.h>

#include "law/bilateral.h"
#include "model/storey_force.h"
#include "solve/dormand_prince/dp.h"

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
    // The rest stays as it is at the start, or is scratch.
    FIELD_ARRAY(struct dp_system, row[DP_C_BELOW], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_C_OWN], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_C_ABOVE], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_GROUND], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_CARRIED], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_DAMPER], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, row[DP_DAMPER_ABOVE], FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, mobility, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, inelastic, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, below, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, building, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, calls, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, damping, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, part_drift, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, part_rate, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, part_shear, FIELD_FLOORS),
    FIELD_ARRAY(struct dp_system, part_history, FIELD_STOREY_HISTORIES),
    FIELD_ARRAY(struct dp_system, part_scratch, FIELD_PART_SCRATCH),
};
const struct fields dp_system_fields = FIELDS(list);

struct storey_response dp_system_storey(const struct dp *p, int i, double drift) {
    return storey_respond(&p->model->storey[i], p->now.storey_history, drift, NULL);
}

double dp_system_shear(const struct dp *p, int i, double drift) {
    const struct dp_system *s = &p->system;
    return s->calls[i] ? dp_system_storey(p, i, drift).shear : s->base[i] + s->tangent[i] * drift;
}

double dp_system_stiffness(const struct dp *p, int i) {
    return p->model->chain.stiffness[i] + p->model->storey[i].pdelta;
}

double dp_system_noise(const struct dp *p, int i) {
    const double drift = p->now.drift[i];
    const double elastic = dp_system_storey(p, i, drift).shear / dp_system_stiffness(p, i);
    const double probe = PROBE * (fabs(drift) + fabs(elastic));
    return fmax(probe, ROUNDING * p->system.most_drift[i]);
}

double dp_system_lag(const struct dp *p, int i) {
    const double drift = p->now.drift[i];
    const double missed = dp_system_shear(p, i, drift) - dp_system_storey(p, i, drift).shear;
    return fabs(missed) / dp_system_stiffness(p, i);
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

void dp_system_branch(struct dp *p, int i, double from, double direction) {
    struct dp_system *s = &p->system;
    if (!s->calls[i]) {
        const double drift = p->now.drift[i];
        const double beyond = from + copysign(dp_system_noise(p, i), direction);
        s->tangent[i] = dp_system_storey(p, i, beyond).tangent;
        s->base[i] = dp_system_storey(p, i, drift).shear - s->tangent[i] * drift;
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
    s->below[i] = floor > 0 ? i - 1 : -1;
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
        dp_system_branch(p, i, p->now.drift[i], p->now.v[i] - p->now.v[s->below[i]]);
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

void dp_system_start(struct dp *p) {
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

void dp_system_commit(struct dp *p) {
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
            now->link_history[l->history + 1] = p->stage[0]->link[i].creep;
        }
    }
    state_commit_links(now, m);
}
