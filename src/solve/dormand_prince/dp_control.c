// SPDX-License-Identifier: GPL-3.0-or-later
// The length of the steps. It follows from the estimated error, of order 5 in the step: Hairer,
// Norsett & Wanner (1993), Solving Ordinary Differential Equations I, eq. II.4.13. (The PI
// controller of volume II, section IV.2, rejects fewer steps and takes a tenth more of them.) Steps
// end at the corners of the forcing, in equal parts from one to the next.
#include "solve/dormand_prince/dp_control.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/number.h"
#include "solve/dormand_prince/dp_stages.h"

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

static double largest_omega(const struct model *m) {
    double omega = 0.0;
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        omega = fmax(omega, g->omega[g->n_floor - 1]);
    }
    return omega;
}

void dp_control_start(struct dp *p) {
    double omega = largest_omega(p->model);
    double first = omega > 0.0 ? FIRST_OF_PERIOD / omega : FIRST_OF_DURATION * p->model->duration;
    p->trial = fmax(first, p->model->control.shortest);
}

double dp_control_limit(const struct dp *p) {
    return number_min(p->system.forcing.corner, p->model->duration);
}

// The next step: a part of the way to the limit.
static void take(struct dp *p) {
    double end = dp_control_limit(p);
    double rest = end - p->now.time;
    double parts = pace_parts(rest, p->trial, p->model->control.longest);
    if (parts > 1.0) {
        dp_stages_take(p, rest / parts, p->now.time + rest / parts);
    } else {
        dp_stages_take(p, rest, end);
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

static int too_short(const struct dp *p, double h, double error, struct error *e) {
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

static int too_slow(const struct dp *p, double step, struct error *e) {
    const char *unit = p->model->deck->units.time_name;
    return error_set(e, STATUS_FAILED,
                     "at t = %.9g %s the steps are %.2g %s because of %s, which makes more than "
                     "%.0e of them; use a larger -tolerance, integrator newmark or step fixed DT",
                     p->now.time, unit, step, unit, cause(p, step), (double)ADAPTIVE_STEPS_MAX);
}

// x^(-1/5) of a normal number, right to 0.4 %: the number whose bits are such a multiple of those
// of x is right to some percent, as the bits of a number are nearly its logarithm, and a step of
// Newton's method mends it.
static double fifth_root_of_inverse(double x) {
    const int64_t of_one = number_bits(1.0);
    int64_t bits = of_one + of_one / 5 - number_bits(x) / 5 + NEAREST;
    double y;
    memcpy(&y, &bits, sizeof y);
    return y * (1.2 - 0.2 * x * (y * y) * (y * y) * y);
}

// The step that would just meet the tolerance over one with this error.
static double change_for(double error) {
    if (!(error > NEGLIGIBLE)) {
        return GROW_MOST;
    }
    return error < DBL_MAX ? SAFETY * fifth_root_of_inverse(error) : SHRINK_MOST;
}

double dp_control_error(const struct dp *p) {
    return dp_stages_error(p) * (p->is_steep ? UNSEEN : 1.0);
}

int dp_control_reject(struct dp *p, double error, struct error *e) {
    p->results->totals.cuts++;
    if (p->h <= p->model->control.shortest || p->now.time + p->h / 2.0 == p->now.time) {
        return too_short(p, p->h, error, e);
    }
    p->trial = p->h * fmin(number_max(change_for(error), SHRINK_MOST), SAFETY);
    p->trial = fmax(p->trial, p->model->control.shortest);
    return STATUS_OK;
}

int dp_control_attempt(struct dp *p, struct error *e) {
    for (;;) {
        take(p);
        double error = dp_control_error(p);
        double step;
        if (pace_is_slow(&p->pace, p->model, p->now.time, &step)) {
            return too_slow(p, step, e);
        }
        if (error <= 1.0) {
            p->trial = p->h * number_min(change_for(error), GROW_MOST);
            return STATUS_OK;
        }
        if (dp_control_reject(p, error, e) != STATUS_OK) {
            return e->status;
        }
    }
}
