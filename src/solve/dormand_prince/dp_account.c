// SPDX-License-Identifier: GPL-3.0-or-later
// Works and impulses are integrals of powers and forces over time. The stages of the method are the
// nodes of a quadrature whose weights are those of the solution, so that they have its order 5; up
// to a place within the step, its continuous extension has order 4. Positions and velocities there
// are those of the Hermite polynomial of degree 5, and everything else follows from them.
#include "solve/dormand_prince/dp_account.h"

#include <math.h>
#include <string.h>

#include "solve/dormand_prince/dp_motion.h"
#include "solve/dormand_prince/dp_peaks.h"
#include "solve/dormand_prince/dp_stages.h"

// Adds the works of the step to the account, but those on links. The weight of the second stage is
// always 0.
static void integrate(const struct dp *p, const double *weight, struct energy_account *energy) {
    dp_stages_work(p, weight, energy);
    for (int s = 0; p->system.special && s < DP_STAGES; s += s == 0 ? 2 : 1) {
        const struct dp_rates *r = p->stage[s];
        double time = p->h * weight[s];
        energy->input += time * r->input;
        energy->damping += time * r->damping;
        energy->storey += time * r->storey;
    }
}

// Gauss's rule with five points (Abramowitz & Stegun 1964, table 25.4), on 0 to 1.
enum { POINTS = 5 };
static const double point[POINTS] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                     0.953089922969332};
static const double point_weight[POINTS] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                            0.239314335249683, 0.118463442528095};

// The work done on link number n of the active ones up to the penetration d, where its force does
// not depend on its velocity: so much the better than the integral of the power, as a closed cycle
// of such a law gives 0 but for the rule. NAN: it does depend.
static double elastic_work(const struct dp *p, int n, double d) {
    int k = p->now.live[n];
    if (p->stage[DP_STAGES - 1]->dfdv[n] != 0.0) {
        return NAN;
    }
    double start = p->now.delta[k];
    double v = (p->rate[0][k] + p->rate[1][k]) / 2.0;
    double work = 0.0;
    for (int i = 0; i < POINTS; i++) {
        struct contact_response r =
            dp_system_response(&p->system, &p->now, k, start + point[i] * (d - start), v);
        if (r.dfdv != 0.0) {
            return NAN;
        }
        work += point_weight[i] * (d - start) * r.force;
    }
    return work;
}

// Work done on link number i of the active ones up to place x, where its penetration is d, and its
// impulse.
static double link_work(const struct dp *p, const double *weight, int i, double d,
                        double *impulse) {
    double elastic = elastic_work(p, i, d);
    double work = 0.0;
    *impulse = 0.0;
    for (int s = 0; s < DP_STAGES; s += s == 0 ? 2 : 1) {
        work += p->h * weight[s] * p->stage[s]->power[i];
        *impulse += p->h * weight[s] * p->stage[s]->force[i];
    }
    return isnan(elastic) ? work : elastic;
}

void dp_account_step(struct dp *p) {
    p->before = p->energy;
    for (int i = 0; i < p->now.n_live; i++) {
        int k = p->now.live[i];
        struct impact_share share = {.steps = 1};
        share.work = link_work(p, dp_stages_whole, i, p->next.delta[k], &share.impulse);
        dp_peaks_link(p, i, &share);
        impacts_add(p->impacts, k, &share);
        p->energy.contact += share.work;
    }
    integrate(p, dp_stages_whole, &p->energy);
}

// The state at place x of the step, and the rates there.
static const struct dp_rates *rates_at(struct dp *p, double x) {
    struct dp_rates *r = p->stage[1];
    dp_motion_between(p, x, r->u, r->v);
    dp_rates_at(&p->system, &p->now, p->now.time + x * p->h, r);
    return r;
}

// Links of a row: open ones as their floors stand, the others with the forces of `rates`.
static void row_links(const struct dp *p, const struct dp_rates *rates, struct state *row) {
    const struct model *m = p->model;
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        row->delta[k] = dp_system_across(l, m, rates->u, rates->ground.u) - l->gap;
        row->link[k].closed = p->now.link[k].closed;
        row->link[k].force = 0.0;
    }
    for (int i = 0; i < p->now.n_live; i++) {
        row->link[p->now.live[i]].force = rates->force[i];
    }
}

static void row_storeys(const struct dp *p, struct state *row) {
    const struct model *m = p->model;
    memcpy(row->storey_history, p->now.storey_history,
           (size_t)m->n_storey_history * sizeof *row->storey_history);
    state_internal_forces(row, m, row->u, row->v);
    for (int n = 0; n < p->system.n_inelastic; n++) {
        int i = p->system.inelastic[n];
        const struct storey *law = &m->storey[i];
        law->law->commit(law->constant, row->storey_history + law->history, row->drift[i]);
    }
}

// The account of energy up to place x of the step.
static void account_up_to(const struct dp *p, double x, struct energy_account *energy) {
    double weight[DP_STAGES];
    dp_stages_weights(x, weight);
    *energy = p->before;
    integrate(p, weight, energy);
    for (int i = 0; i < p->now.n_live; i++) {
        struct motion motion = dp_motion_link(p, p->now.live[i]);
        struct polynomial path = hermite_position(&motion);
        double impulse;
        energy->contact += link_work(p, weight, i, hermite_value(&path, x), &impulse);
    }
}

static void row_floors(const struct dp *p, const struct dp_rates *rates, struct state *row) {
    const struct model *m = p->model;
    size_t size = (size_t)m->n_dof * sizeof(double);
    memcpy(row->u, rates->u, size);
    memcpy(row->v, rates->v, size);
    memcpy(row->a, rates->a, size);
    memcpy(row->ground_a, rates->ground.a, (size_t)m->n_ground * sizeof(double));
    memcpy(row->ground_v, rates->ground.v, (size_t)m->n_ground * sizeof(double));
    for (int i = 0; i < m->n_dof; i++) {
        int ground = m->building[p->system.building[i]].ground;
        row->total[i] = row->a[i] + row->ground_a[ground];
    }
}

void dp_account_row(struct dp *p, double t, struct state *row, struct energy_account *energy) {
    const struct dp_rates *rates = p->stage[0];
    *energy = p->energy;
    if (p->h > 0.0) {
        double x = t < p->next.time ? (t - p->now.time) / p->h : 1.0;
        account_up_to(p, x, energy);
        rates = x < 1.0 ? rates_at(p, x) : p->stage[DP_STAGES - 1];
    }
    row->time = t;
    row_floors(p, rates, row);
    row_storeys(p, row);
    row_links(p, rates, row);
}
