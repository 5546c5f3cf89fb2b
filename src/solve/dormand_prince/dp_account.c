// SPDX-License-Identifier: GPL-3.0-or-later
// Works and impulses of a step, and the state within it.
//
// Works and impulses are integrals of powers and forces over time. The stages of the method are the
// nodes of a quadrature whose weights are those of the solution, so that they have its order 5; up
// to a place within the step, its continuous extension has order 4. Positions and velocities there
// are those of the Hermite polynomial of degree 5, and everything else follows from them.
#include <math.h>
#include <string.h>

#include "core/number.h"
#include "core/root.h"
#include "solve/dormand_prince/dp.h"

// Gauss's rule with five points (Abramowitz & Stegun 1964, table 25.4), on 0 to 1.
enum { POINTS = 5 };
static const double point[POINTS] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                     0.953089922969332};
static const double point_weight[POINTS] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                            0.239314335249683, 0.118463442528095};

// Place of the largest force of a link, in the step: the force errs by the square.
static const double PLACED = 1e-4;

// Times by which what the stages have is multiplied in its integral up to place x of the step. The
// continuous extension of order 4: Shampine (1986), Math. Comp. 46, 135-150; here as in Hairer,
// Norsett & Wanner, eq. II.6.12. The second stage has none.
static void dp_times(const struct dp *p, double x, double *time) {
    static const double whole[DP_STAGES] = {
        35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0};
    double rise = x * x * (3.0 - 2.0 * x);
    for (int s = 0; s < DP_STAGES; s++) {
        time[s] = rise * whole[s];
    }
    if (x < 1.0) {
        double bump = x * x * (x - 1.0) * (x - 1.0);
        time[0] += x * (x - 1.0) * (x - 1.0) -
                   bump * 5.0 * (2558722523.0 - 31403016.0 * x) / 11282082432.0;
        time[2] += bump * 100.0 * (882725551.0 - 15701508.0 * x) / 32700410799.0;
        time[3] -= bump * 25.0 * (443332067.0 - 31403016.0 * x) / 1880347072.0;
        time[4] += bump * 32805.0 * (23143187.0 - 3489224.0 * x) / 199316789632.0;
        time[5] -= bump * 55.0 * (29972135.0 - 7076736.0 * x) / 822651844.0;
        time[6] = x * x * (x - 1.0) + bump * 10.0 * (7414447.0 - 829305.0 * x) / 29380423.0;
    }
    for (int s = 0; s < DP_STAGES; s++) {
        time[s] *= p->h;
    }
}

// Adds the works of these times to the account, but those on links.
static void dp_integrate(const struct dp *p, const double *time, struct energy_account *energy) {
    p->floors->work(p, time, energy);
    for (int s = 0; p->system.special && s < DP_STAGES; s += s == 0 ? 2 : 1) {
        const struct dp_rates *r = &p->stage[s];
        energy->input += time[s] * r->input;
        energy->damping += time[s] * r->damping;
        energy->storey += time[s] * r->storey;
    }
}

// The work done on link number n of the live ones up to the penetration d, where its force does
// not depend on its velocity: so much the better than the integral of the power, as a closed cycle
// of such a law gives 0 but for the rule. NAN: it does depend.
static double dp_elastic_work(const struct dp *p, int n, double d) {
    int k = p->now.live[n];
    if (p->stage[DP_LAST].link[n].response.dfdv != 0.0 || p->model->link[k].law->creep) {
        return NAN;
    }
    double start = p->now.delta[k];
    double v = (p->rate[0][k] + p->rate[1][k]) / 2.0;
    double work = 0.0;
    for (int i = 0; i < POINTS; i++) {
        struct contact_response r = dp_rates_response(p, k, start + point[i] * (d - start), v);
        if (r.dfdv != 0.0) {
            return NAN;
        }
        work += point_weight[i] * (d - start) * r.force;
    }
    return work;
}

// Work and impulse of link number i of the live ones in these times, at the end of which its
// penetration is d.
static struct impact_share dp_link_share(const struct dp *p, const double *time, int i, double d) {
    const double elastic = dp_elastic_work(p, i, d);
    struct impact_share share = {.steps = 1};
    for (int s = 0; s < DP_STAGES; s += s == 0 ? 2 : 1) {
        share.work += time[s] * p->stage[s].link[i].power;
        share.impulse += time[s] * p->stage[s].link[i].response.force;
    }
    share.work = isnan(elastic) ? share.work : elastic;
    return share;
}

// The account of energy up to place x of the step.
static void dp_account_up_to(const struct dp *p, double x, struct energy_account *energy) {
    double time[DP_STAGES];
    dp_times(p, x, time);
    *energy = p->before;
    dp_integrate(p, time, energy);
    for (int i = 0; i < p->now.n_live; i++) {
        struct motion motion = dp_motion_link(p, p->now.live[i]);
        struct polynomial path = hermite_path(&motion);
        energy->contact += dp_link_share(p, time, i, hermite_value(&path, x)).work;
    }
}

// A row: links that are open as their floors stand, the others with the forces of `rates`.
static void dp_row(const struct dp *p, const struct dp_rates *rates, struct state *row) {
    const struct model *m = p->model;
    const size_t floors = (size_t)m->n_dof * sizeof(double);
    const size_t grounds = (size_t)m->n_ground * sizeof(double);
    memcpy(row->u, rates->u, floors);
    memcpy(row->v, rates->v, floors);
    memcpy(row->a, rates->a, floors);
    memcpy(row->ground_a, rates->ground.a, grounds);
    memcpy(row->ground_v, rates->ground.v, grounds);
    memcpy(row->ground_u, rates->ground.u, grounds);
    for (int i = 0; i < m->n_dof; i++) {
        row->total[i] = row->a[i] + row->ground_a[m->building[p->system.building[i]].ground];
    }
    state_forces(row, m, p->now.storey_history, row->storey_history);
    for (int k = 0; k < m->n_link; k++) {
        row->delta[k] = state_penetration(row, m, k);
        row->link[k].closed = p->now.link[k].closed;
        row->link[k].force = 0.0;
    }
    for (int i = 0; i < p->now.n_live; i++) {
        row->link[p->now.live[i]].force = rates->link[i].response.force;
    }
}

void dp_account_row(struct dp *p, double t, struct state *row, struct energy_account *energy) {
    const struct dp_rates *rates = &p->stage[0];
    *energy = p->energy;
    if (p->h > 0.0) {
        double x = t < p->next.time ? (t - p->now.time) / p->h : 1.0;
        dp_account_up_to(p, x, energy);
        rates = &p->stage[DP_LAST];
        if (x < 1.0) {
            dp_rates_within(p, x, DP_ALL);
            rates = &p->stage[1];
        }
    }
    row->time = t;
    memcpy(row->link_history, p->now.link_history,
           (size_t)p->model->n_link_history * sizeof *row->link_history);
    dp_row(p, rates, row);
}

// Largest penetration of link k in the step: at its end, or where it turns.
static double dp_penetration(struct dp *p, int k, const struct motion *m) {
    double largest = peaks_size(p->model, k, m->d[1]);
    peaks_penetration(p->results, k, largest, p->next.time);
    if (m->v[0] * m->v[1] < 0.0) {
        const struct motion_pieces s = hermite_cut(m);
        for (int j = 1; j < s.n; j++) {
            const double d = peaks_size(p->model, k, s.d[j]);
            largest = fmax(largest, d);
            peaks_penetration(p->results, k, d, p->now.time + s.x[j] * p->h);
        }
    }
    return largest;
}

// The force of link number i of the live ones at place x of its path in the step, and its rate.
static double dp_link_force(const struct dp *p, int i, const struct polynomial *path, double x,
                            double *rate) {
    const double d = hermite_value(path, x), v = hermite_slope(path, x) / p->h;
    const double a = hermite_bend(path, x) / (p->h * p->h);
    struct dp_link_rates r = {.creep = dp_rates_creep(p, i, x)};
    dp_rates_link(p, i, d, v, &r);
    *rate = r.response.dfdd * (v - r.flow) + r.response.dfdv * a;
    return r.response.force;
}

// The force of link number i of the live ones where its rate changes its sign inside the step, and
// when; the one at the end where it does not.
static double dp_inner_force(const struct dp *p, int i, const struct motion *m, double *time) {
    const struct dp_link_rates *first = &p->stage[0].link[i];
    const struct dp_link_rates *last = &p->stage[DP_LAST].link[i];
    const double start =
        first->response.dfdd * (m->v[0] - first->flow) + first->response.dfdv * m->a[0];
    double rate = last->response.dfdd * (m->v[1] - last->flow) + last->response.dfdv * m->a[1];
    double force = last->response.force;
    *time = p->next.time;
    if (start * rate >= 0.0 || dp_step_is_instant(p)) {
        return force;
    }
    const struct polynomial path = hermite_path(m);
    struct root at = {.high = 1.0};
    while (at.high - at.low > PLACED) {
        const double x = root_middle(&at);
        force = dp_link_force(p, i, &path, x, &rate);
        *time = p->now.time + x * m->h;
        root_halve(&at, start * rate > 0.0);
    }
    return force;
}

// The largest force and penetration of link number i of the live ones in the step.
static void dp_link_peaks(struct dp *p, int i, struct impact_share *share) {
    const int k = p->now.live[i];
    const struct motion m = dp_motion_link(p, k);
    double time;
    const double inner = dp_inner_force(p, i, &m, &time);
    const double end = p->stage[DP_LAST].link[i].response.force;
    peaks_force(p->results, k, peaks_size(p->model, k, end), p->next.time);
    peaks_force(p->results, k, peaks_size(p->model, k, inner), time);
    share->force = number_max(end, inner);
    share->penetration = dp_penetration(p, k, &m);
}

void dp_account_step(struct dp *p) {
    double time[DP_STAGES];
    dp_times(p, 1.0, time);
    p->before = p->energy;
    for (int i = 0; i < p->now.n_live; i++) {
        const int k = p->now.live[i];
        struct impact_share share = dp_link_share(p, time, i, p->next.delta[k]);
        dp_link_peaks(p, i, &share);
        impacts_add(p->impacts, k, &share);
        p->energy.contact += share.work;
    }
    dp_integrate(p, time, &p->energy);
    for (int n = 0; n < p->system.n_inelastic; n++) {
        const int i = p->system.inelastic[n];
        for (int s = 0; s < DP_STAGES; s += s == 0 ? 2 : 1) {
            p->energy.storey_own[i] += time[s] * p->stage[s].power[i];
        }
    }
    for (int k = 0, n = p->deepens ? p->model->n_contact : 0; k < n; k++) {
        if (p->reach[k] > p->results->deepest[k] && !p->now.link[k].closed) {
            const struct motion m = dp_motion_link(p, k);
            dp_penetration(p, k, &m);
        }
    }
}
