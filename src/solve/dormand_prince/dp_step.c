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
#include "core/number.h"
#include "solve/dormand_prince/dp.h"

static const double SAFETY = 0.9;
static const double SHRINK_MOST = 0.2, GROW_MOST = 5.0;
static const double CREEPING = 2.0, CREEPING_SHARE = 1e-3;  // the method is stable up to 3.3
static const double NEGLIGIBLE = 1e-4;                      // less than (SAFETY / GROW_MOST)^5

// The bits of a number are nearly its logarithm. With this offset they err as much to both sides.
static const int64_t NEAREST = -60 * (INT64_C(1) << 52) / 1000;

// The error of the first step over its estimate, where the force grows like t^(1/4). For sum b_i
// c_i^(1/4) - 4/5 over sum e_i c_i^(1/4), with the nodes and weights of the method and of its
// estimate, it is 51.5; for larger exponents it is less.
static const double UNSEEN = 51.5;

// First step over the shortest period of a building over 2 pi, or over the duration.
static const double FIRST_OF_PERIOD = 1e-2, FIRST_OF_DURATION = 1e-6;

// No peak is looked for in a step that is shorter than this share of the largest displacement over
// the largest velocity, as between two events: rounding of displacements changes the interpolated
// velocities by more than a peak could.
static const double INSTANT = 1e-8;

// Steps in which rounding may hide the errors of accelerations: an impact takes less.
enum { NOISY = 1000 };

// Squares of frequencies that differ by less than this factor make the same scales.
static const double SAME_SCALE = 1.25;

void dp_step_take(struct dp *p, double h, double end) {
    p->h = h;
    p->next.time = end;
    p->floors->take(p);
}

// The differences of u and v over the links, a run of links at a time.
LANES static void dp_differences(const struct gaps *g, const double *restrict u,
                                 const double *restrict v, double *restrict delta,
                                 double *restrict rate) {
    for (int i = 0; i < g->n_run; i++) {
        const struct gap_run *r = &g->run[i];
        const double *gap = g->gap + r->gap;
        if (r->row) {
            delta[r->first] = link_across(r->row, u) - gap[0];
            rate[r->first] = link_across(r->row, v);
            continue;
        }
        for (int j = 0; j < r->n; j++) {
            delta[r->first + j] = u[r->left + j] - u[r->right + j] - gap[j];
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
    f->building = arena_alloc(a, (size_t)m->n_body, sizeof *f->building);
    f->most = arena_alloc(a, (size_t)m->n_body, sizeof *f->most);
    p->scales.square = arena_alloc(a, (size_t)m->n_body, sizeof *p->scales.square);
    p->scales.memory = arena_alloc(a, (size_t)m->n_body, sizeof *p->scales.memory);
    return !arena_failed(a);
}

// The longest step for the state of live link n, whose spring k relaxes at the rate k dw/dF. The
// force is taken to be at least that of the spring at a small displacement.
static double dp_creeping_step(const struct dp *p, int n) {
    const struct link *l = &p->model->link[p->now.live[n]];
    const struct contact_response *r = &p->stage[0].link[n].response;
    const double force = fmax(fabs(r->force), CREEPING_SHARE * r->dfdd * p->scales.most_u);
    const double change =
        l->law->creep(l->constant, 2.0 * force) - l->law->creep(l->constant, force);
    return change > 0.0 ? CREEPING * force / (r->dfdd * change) : INFINITY;
}

// Adds the stiffness and the dashpot of live link n to the sums at its floors. A contact's
// stiffness is that of its law at v = 0: at closure the slope in d of a force that depends on d and
// v may be infinite.
static void dp_add_link(struct dp *p, int n) {
    struct dp_fastest *f = &p->fastest;
    const int k = p->now.live[n];
    const struct link *l = &p->model->link[k];
    const struct dp_rates *r = &p->stage[0];
    const bool unbounded = l->bilateral && bilateral_is_steep(l->law, l->constant);
    if (l->law->creep) {
        f->longest = number_min(f->longest, dp_creeping_step(p, n));
    }
    const double dfdd = l->bilateral ? r->link[n].response.dfdd
                                     : dp_rates_response(p, k, p->now.delta[k], 0.0).dfdd;
    for (int end = 0; end < 2; end++) {
        for (int i = 0; i < link_entries(l, end); i++) {
            const int dof = link_entry(l, end, i).dof;
            f->spring[dof] += fabs(dfdd) / l->mass;
            f->dashpot[dof] += unbounded ? 0.0 : fabs(r->link[n].response.dfdv) / l->mass;
        }
    }
}

// Takes the sums at the floors of live link n into the bounds, and clears them.
static void dp_take_link(struct dp *p, int n) {
    struct dp_fastest *f = &p->fastest;
    const struct link *l = &p->model->link[p->now.live[n]];
    for (int end = 0; end < 2; end++) {
        for (int i = 0; i < link_entries(l, end); i++) {
            const int dof = link_entry(l, end, i).dof, k = l->building[end];
            const double step = stability_step(&f->building[k], f->spring[dof], f->dashpot[dof]);
            f->longest = number_min(f->longest, step);
            f->most[k] = number_max(f->most[k], f->spring[dof]);
            f->spring[dof] = f->dashpot[dof] = 0.0;
        }
    }
}

// The scales follow larger changes.
static void dp_update_fastest(struct dp *p) {
    struct dp_fastest *f = &p->fastest;
    if (p->now.n_live == 0 && !f->linked) {
        return;
    }
    f->linked = p->now.n_live > 0;
    f->longest = f->alone;
    for (int n = 0; n < p->now.n_live; n++) {
        dp_add_link(p, n);
    }
    for (int n = 0; n < p->now.n_live; n++) {
        dp_take_link(p, n);
    }
    for (int k = 0; k < p->model->n_body; k++) {
        const double square = f->building[k].square + f->most[k];
        double *scale = &p->scales.square[k];
        if (square > SAME_SCALE * *scale || SAME_SCALE * square < *scale) {
            *scale = square;
            p->grown = true;
        }
        f->most[k] = 0.0;
    }
}

void dp_step_start(struct dp *p) {
    const struct model *m = p->model;
    struct dp_fastest *f = &p->fastest;
    double omega = 0.0;
    f->alone = m->control.longest;
    for (int k = 0; k < m->n_body; k++) {
        const struct building *g = &m->building[k];
        omega = fmax(omega, g->omega[g->n_dof - 1]);
        f->building[k] = stability_of(g);
        f->alone = fmin(f->alone, stability_step(&f->building[k], 0.0, 0.0));
        p->scales.square[k] = f->building[k].square;
        p->scales.memory[k] = fmin(f->building[k].memory, m->duration);
    }
    f->longest = f->alone;
    const double first = omega > 0.0 ? FIRST_OF_PERIOD / omega : FIRST_OF_DURATION * m->duration;
    p->trial = fmax(first, m->control.shortest);
}

double dp_step_limit(const struct dp *p) {
    return number_min(p->system.forcing.corner, p->model->duration);
}

bool dp_step_is_instant(const struct dp *p) {
    return p->h * p->scales.most_v < INSTANT * p->scales.most_u;
}

// What makes steps of h short: the link that is stiffest at its state, the last contact that had an
// event, or the tolerance.
static struct pace_cause dp_cause(const struct dp *p, double h, const char *remedy) {
    const struct model *m = p->model;
    const char *name = p->last_link < 0 ? "the tolerance" : m->link[p->last_link].name;
    double fastest = 0.5 / h;  // slower ones do not matter
    for (int i = 0; i < p->now.n_live; i++) {
        const int k = p->now.live[i];
        const struct contact_response r = dp_rates_response(p, k, p->now.delta[k], p->rate[0][k]);
        const double mass = m->link[k].mass;
        const double rate = fmax(fabs(r.dfdv) / mass, sqrt(fabs(r.dfdd) / mass));
        if (rate > fastest) {
            fastest = rate;
            name = m->link[k].name;
        }
    }
    return (struct pace_cause){name, remedy};
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

// The next instant in the step, after x, at which the parts of building `g` are looked at: POINTS
// shares of the step, and turns of drifts.
static double dp_way_stop(const struct dp *p, const struct building *g, double x) {
    enum { POINTS = 4 };
    static const double SAME = 1e-9;
    double next = (floor(x * POINTS + SAME) + 1.0) / POINTS;
    for (int i = g->first; i < g->first + g->n_dof; i++) {
        const struct motion m = dp_motion(p, dp_drift, 0, i);
        const struct motion_pieces s = hermite_cut(&m);
        for (int j = 1; j < s.n; j++) {
            next = s.x[j] > x + SAME ? fmin(next, s.x[j]) : next;
        }
    }
    return next;
}

// The error of the drifts of building `g` over that allowed by turns of its parts within the step,
// which the stages do not see: the history at the end depends on the way there. It is the
// difference of the shears at the end with the histories that the way commits, which are left in
// part_history, and with those of its start.
static double dp_way_error(const struct dp *p, int k) {
    const struct building *g = &p->model->building[k];
    double *after = p->system.part_history;
    const struct dp_rates *r = &p->stage[1];  // its weight in the step is 0
    double *kept = r->a + g->first;
    const double allowed = p->model->control.tolerance * p->scales.most_u;
    double largest = 0.0;
    const double *history = p->now.storey_history;
    for (double x = dp_way_stop(p, g, 0.0); x < 1.0; x = dp_way_stop(p, g, x)) {
        dp_rates_move(p, x, k);
        dp_rates_parts(p, g, history, r->u, r->v, after);
        history = after;
    }
    const double *shear = dp_rates_parts(p, g, p->now.storey_history, p->next.u, p->next.v, NULL);
    memcpy(kept, shear, (size_t)g->n_dof * sizeof *kept);
    dp_rates_parts(p, g, after, p->next.u, p->next.v, NULL);
    for (int i = 0; i < g->n_dof; i++) {
        const double change = fabs(shear[i] - kept[i]);
        largest = change > 0.0 ? fmax(largest, change / (g->stiffness[i] * allowed)) : largest;
    }
    return largest;
}

static double dp_part_error(const struct dp *p) {
    double largest = 0.0;
    for (int k = 0; k < p->model->n_body && !p->model->elastic; k++) {
        const struct building *g = &p->model->building[k];
        int n_history = 0;
        for (int i = 0; i < g->n_part; i++) {
            n_history += g->part[i].n_history;
        }
        largest = n_history > 0 ? fmax(largest, dp_way_error(p, k)) : largest;
    }
    return largest;
}

double dp_step_error(const struct dp *p) {
    const double largest = p->floors->error(p) / p->model->control.tolerance;
    if (!isfinite(largest)) {
        return INFINITY;
    }
    return number_max(dp_part_error(p), largest * (p->is_steep ? UNSEEN : 1.0));
}

int dp_step_reject(struct dp *p, double error, struct error *e) {
    const struct model *m = p->model;
    const double time = p->now.time;
    p->results->totals.rejected++;
    if (pace_can_shorten(m, time, p->h)) {
        p->trial = p->h * fmin(number_max(dp_change_for(error), SHRINK_MOST), SAFETY);
        p->trial = fmax(p->trial, m->control.shortest);
        return STATUS_OK;
    }
    if (!isfinite(error)) {
        return error_set(e, STATUS_FAILED, "the state is not finite at t = %.9g %s", time,
                         m->deck->units.time_name);
    }
    const struct pace_cause cause = dp_cause(p, p->h, ", integrator newmark");
    return pace_too_long(m, time, p->h, &cause, e);
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
    const struct model *m = p->model;
    const double goal = dp_step_limit(p);
    dp_update_fastest(p);
    p->noisy = p->scales.noisy < 0 ? 0 : p->noisy + 1;
    if (p->noisy > NOISY) {
        return dp_too_noisy(p, e);
    }
    for (;;) {
        double h, end, mean;
        pace_next(p->now.time, goal, p->trial, p->fastest.longest, &h, &end);
        dp_step_take(p, h, end);
        const double error = dp_step_error(p);
        if (pace_is_slow(&p->pace, m, p->now.time, &mean)) {
            const struct pace_cause cause =
                dp_cause(p, mean, "integrator newmark or step fixed DT");
            return pace_too_slow(m, p->now.time, mean, &cause, e);
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
