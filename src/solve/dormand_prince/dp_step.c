// SPDX-License-Identifier: GPL-3.0-or-later
// A step by the stages of the method (dp_floors.h), and how long it is.
//
// Its length follows from the estimated error, of order 5 in the step: Hairer, Norsett & Wanner
// (1993), Solving Ordinary Differential Equations I, eq. II.4.13. (The PI controller of volume II,
// section IV.2, rejects fewer steps and takes a tenth more of them.) Steps end at the corners of
// the forcing, in equal parts from one to the next.
//
// It is bounded by the fastest motions that the system can make on its present branches. Buildings
// do not change: a storey that yields is softer than at first. Links come and go, and stiffen;
// those of the step before are the bound for the next. Left to the estimate of the error is what
// has no bound: dampers with an infinite slope at v = 0.
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/arena.h"
#include "core/lanes.h"
#include "core/number.h"
#include "solve/dormand_prince/dp.h"
#include "solve/dormand_prince/dp_parts.h"

static const double SAFETY = 0.9;
static const double SHRINK_MOST = 0.2, GROW_MOST = 5.0;
static const double NEGLIGIBLE = 1e-4;  // less than (SAFETY / GROW_MOST)^5

// What makes the bits of a number, taken as its logarithm, err as much to both sides.
static const int64_t NEAREST = -60 * (INT64_C(1) << 52) / 1000;

// The error of the first step over its estimate, where the force grows like t^(1/4). For sum b_i
// c_i^(1/4) - 4/5 over sum e_i c_i^(1/4), with the nodes and weights of the method and of its
// estimate, it is 51.5; for larger exponents it is less.
static const double UNSEEN = 51.5;

// First step over the shortest period of a building over 2 pi, or over the duration.
static const double FIRST_OF_PERIOD = 1e-2, FIRST_OF_DURATION = 1e-6;

// Steps in which rounding may hide the errors of accelerations: an impact takes less.
enum { NOISY = 1000 };

// Squares of frequencies that differ by less than this factor make the same scales.
static const double SAME_SCALE = 1.25;

void dp_step_first(struct dp *p) {
    dp_rates_at(&p->system, &p->now, p->now.time, DP_ALL, p->stage[0]);
}

void dp_step_take(struct dp *p, double h, double end) {
    p->h = h;
    p->next.time = end;
    p->system.floors->take(p);
}

// The differences of u and v over the links, a run of links at a time.
LANES static void dp_differences(const struct gaps *g, const double *restrict u,
                                 const double *restrict v, double *restrict delta,
                                 double *restrict rate) {
    for (int i = 0; i < g->n_run; i++) {
        const struct gap_run *r = &g->run[i];
        if (r->row) {
            delta[r->first] = link_across(r->row, u) - g->gap[r->first];
            rate[r->first] = link_across(r->row, v);
            continue;
        }
        for (int j = 0; j < r->n; j++) {
            delta[r->first + j] = u[r->left + j] - u[r->right + j] - g->gap[r->first + j];
            rate[r->first + j] = v[r->left + j] - v[r->right + j];
        }
    }
}

void dp_step_gaps(const struct dp *p, struct state *s, double *rate) {
    const struct model *m = p->model;
    dp_differences(&p->gaps, s->u, s->v, s->delta, rate);
    for (int k = 0; m->n_ground > 1 && k < m->n_link; k++) {
        s->delta[k] = state_penetration(s, m, k);
        rate[k] = state_rate(s, m, k);
    }
}

bool dp_step_alloc(struct dp *p, struct arena *a) {
    const struct model *m = p->model;
    struct dp_fastest *f = &p->fastest;
    f->building = arena_alloc(a, (size_t)m->n_building, sizeof *f->building);
    f->spring = arena_alloc(a, (size_t)m->n_dof, sizeof *f->spring);
    f->dashpot = arena_alloc(a, (size_t)m->n_dof, sizeof *f->dashpot);
    f->most = arena_alloc(a, (size_t)m->n_building, sizeof *f->most);
    p->scales.square = arena_alloc(a, (size_t)m->n_building, sizeof *p->scales.square);
    p->scales.memory = arena_alloc(a, (size_t)m->n_building, sizeof *p->scales.memory);
    return !arena_failed(a);
}

static void dp_start_fastest(struct dp *p) {
    const struct model *m = p->model;
    struct dp_fastest *f = &p->fastest;
    f->alone = m->control.longest;
    for (int k = 0; k < m->n_building; k++) {
        f->building[k] = stability_of(&m->building[k]);
        f->alone = fmin(f->alone, stability_step(&f->building[k], 0.0, 0.0));
        p->scales.square[k] = f->building[k].square;
        p->scales.memory[k] = fmin(f->building[k].memory, m->duration);
    }
    f->longest = f->alone;
}

// Stiffness and dashpot of live link n. A contact's stiffness is that of its law at v = 0: at
// closure the slope in d of a force that depends on d and v may be infinite.
static void dp_slopes(const struct dp *p, int n, double *spring, double *dashpot) {
    int k = p->now.live[n];
    const struct link *l = &p->model->link[k];
    const struct dp_rates *r = p->stage[0];
    double dfdd = l->bilateral
                      ? r->dfdd[n]
                      : dp_system_response(&p->system, &p->now, k, p->now.delta[k], 0.0).dfdd;
    bool unbounded = l->bilateral && p->system.phase[k] != PHASE_ANY;
    *spring = fabs(dfdd) / l->mass;
    *dashpot = unbounded ? 0.0 : fabs(r->dfdv[n]) / l->mass;
}

// Adds the live links to the sums at their floors.
static void dp_add_links(struct dp *p) {
    struct dp_fastest *f = &p->fastest;
    for (int n = 0; n < p->now.n_live; n++) {
        const struct link *l = &p->model->link[p->now.live[n]];
        double spring, dashpot;
        dp_slopes(p, n, &spring, &dashpot);
        for (int end = 0; end < 2; end++) {
            for (int i = 0; i < link_entries(l, end); i++) {
                f->spring[link_entry(l, end, i).dof] += spring;
                f->dashpot[link_entry(l, end, i).dof] += dashpot;
            }
        }
    }
}

// Takes floor i into the bounds, and clears its sums.
static void dp_take_floor(struct dp *p, int building, int i) {
    struct dp_fastest *f = &p->fastest;
    const struct stability *s = &f->building[building];
    f->longest = number_min(f->longest, stability_step(s, f->spring[i], f->dashpot[i]));
    f->most[building] = number_max(f->most[building], f->spring[i]);
    f->spring[i] = f->dashpot[i] = 0.0;
}

// The scales follow larger changes.
static void dp_follow(struct dp *p, int building) {
    struct dp_fastest *f = &p->fastest;
    double square = f->building[building].square + f->most[building];
    double *scale = &p->scales.square[building];
    if (square > SAME_SCALE * *scale || SAME_SCALE * square < *scale) {
        *scale = square;
        p->grown = true;
    }
    f->most[building] = 0.0;
}

static void dp_update_fastest(struct dp *p) {
    struct dp_fastest *f = &p->fastest;
    if (p->now.n_live == 0 && !f->linked) {
        return;
    }
    f->linked = p->now.n_live > 0;
    f->longest = f->alone;
    dp_add_links(p);
    for (int n = 0; n < p->now.n_live; n++) {
        const struct link *l = &p->model->link[p->now.live[n]];
        for (int end = 0; end < 2; end++) {
            for (int i = 0; i < link_entries(l, end); i++) {
                dp_take_floor(p, l->building[end], link_entry(l, end, i).dof);
            }
        }
    }
    for (int k = 0; k < p->model->n_building; k++) {
        dp_follow(p, k);
    }
}

void dp_step_start(struct dp *p) {
    const struct model *m = p->model;
    double omega = 0.0;
    for (int k = 0; k < m->n_building; k++) {
        omega = fmax(omega, m->building[k].omega[m->building[k].n_floor - 1]);
    }
    double first = omega > 0.0 ? FIRST_OF_PERIOD / omega : FIRST_OF_DURATION * m->duration;
    p->trial = fmax(first, m->control.shortest);
    dp_start_fastest(p);
}

double dp_step_limit(const struct dp *p) {
    return number_min(p->system.forcing.corner, p->model->duration);
}

// The next step: a part of the way to the limit.
static void dp_take(struct dp *p) {
    double end = dp_step_limit(p);
    double rest = end - p->now.time;
    double parts = pace_parts(rest, p->trial, p->fastest.longest);
    if (parts > 1.0) {
        dp_step_take(p, rest / parts, p->now.time + rest / parts);
    } else {
        dp_step_take(p, rest, end);
    }
}

// What makes steps of h short, as text: the link that is stiffest at its state, the last contact
// that had an event, or the tolerance.
static const char *cause(const struct dp *p, double h) {
    const struct model *m = p->model;
    const char *name = p->last_link < 0 ? "the tolerance" : m->link[p->last_link].name;
    double fastest = 0.5 / h;  // slower ones do not matter
    for (int i = 0; i < p->now.n_live; i++) {
        int k = p->now.live[i];
        struct contact_response r =
            dp_system_response(&p->system, &p->now, k, p->now.delta[k], p->rate[0][k]);
        double rate = fmax(fabs(r.dfdv) / m->link[k].mass, sqrt(fabs(r.dfdd) / m->link[k].mass));
        if (rate > fastest) {
            fastest = rate;
            name = m->link[k].name;
        }
    }
    return name;
}

static int dp_too_short(const struct dp *p, double h, double error, struct error *e) {
    const char *unit = p->model->deck->units.time_name;
    if (!isfinite(error)) {
        return error_set(e, STATUS_FAILED, "the state is not finite at t = %.9g %s", p->now.time,
                         unit);
    }
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s a step of %.3g %s is still too long for %s; use a larger "
                     "-tolerance, a smaller -min, integrator newmark or step fixed DT",
                     p->now.time, unit, h, unit, cause(p, h));
}

static int dp_too_slow(const struct dp *p, double step, struct error *e) {
    const char *unit = p->model->deck->units.time_name;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s the steps are %.2g %s because of %s, which makes more than "
                     "%.0e of them; use a larger -tolerance, integrator newmark or step fixed DT",
                     p->now.time, unit, step, unit, cause(p, step), (double)ADAPTIVE_STEPS_MAX);
}

// x^(-1/5) of a normal number, right to 0.4 %: the number whose bits are such a multiple of those
// of x is right to some percent, as the bits of a number are nearly its logarithm, and a step of
// Newton's method mends it.
static double dp_fifth_root_of_inverse(double x) {
    const int64_t of_one = number_bits(1.0);
    int64_t bits = of_one + of_one / 5 - number_bits(x) / 5 + NEAREST;
    double y;
    memcpy(&y, &bits, sizeof y);
    return y * (1.2 - 0.2 * x * (y * y) * (y * y) * y);
}

// The step that would just meet the tolerance over one with this error.
static double dp_change_for(double error) {
    if (!(error > NEGLIGIBLE)) {
        return GROW_MOST;
    }
    return error < DBL_MAX ? SAFETY * dp_fifth_root_of_inverse(error) : SHRINK_MOST;
}

double dp_step_error(const struct dp *p) {
    double largest = p->system.floors->error(p) / p->model->control.tolerance;
    if (!isfinite(largest)) {
        return INFINITY;
    }
    const double parts = p->model->elastic ? 0.0 : dp_parts_error(p);
    return number_max(parts, largest * (p->is_steep ? UNSEEN : 1.0));
}

int dp_step_reject(struct dp *p, double error, struct error *e) {
    p->results->totals.rejected++;
    if (p->h <= p->model->control.shortest || p->now.time + p->h / 2.0 == p->now.time) {
        return dp_too_short(p, p->h, error, e);
    }
    p->trial = p->h * fmin(number_max(dp_change_for(error), SHRINK_MOST), SAFETY);
    p->trial = fmax(p->trial, p->model->control.shortest);
    return STATUS_OK;
}

static int dp_too_noisy(const struct dp *p, struct error *e) {
    const struct model *m = p->model;
    return error_set(
        e, STATUS_FAILED,
        "at t = %.9g %s displacements of building %s are rounded by more than its "
        "accelerations allow at a tolerance of %g; use a larger -tolerance, integrator "
        "newmark or step fixed DT",
        p->now.time, m->deck->units.time_name, m->building[p->scales.noisy].name,
        m->control.tolerance);
}

int dp_step_attempt(struct dp *p, struct error *e) {
    dp_update_fastest(p);
    p->noisy = p->scales.noisy < 0 ? 0 : p->noisy + 1;
    if (p->noisy > NOISY) {
        return dp_too_noisy(p, e);
    }
    for (;;) {
        dp_take(p);
        double error = dp_step_error(p);
        double step;
        if (pace_is_slow(&p->pace, p->model, p->now.time, &step)) {
            return dp_too_slow(p, step, e);
        }
        if (error <= 1.0) {
            p->trial = p->h * number_min(dp_change_for(error), GROW_MOST);
            return STATUS_OK;
        }
        if (dp_step_reject(p, error, e) != STATUS_OK) {
            return e->status;
        }
    }
}
