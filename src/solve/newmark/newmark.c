// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark (1959), J. Eng. Mech. Div. ASCE 85(3), 67-94. The trial is the end of the step if the
// accelerations stayed, and q their correction:
//     u = u_t + beta h^2 q,   u_t = u_n + h v_n + h^2 a_n / 2,
//     v = v_t + gamma h q,    v_t = v_n + h a_n,                  a = a_n + q.
// Equilibrium M a + C v + f_s(u) + B' f = p is solved for q at the end of the step,
//     A q = p - M a_n - C v_t - f_s(u_t) - B' f,   A = M + gamma h C + beta h^2 K.
// This form holds for any beta >= 0, and loses no digits in small steps, where A -> M.
//
// Storeys: Newton's method with their consistent tangents, building by building. A building whose
// storeys turn out to be on the branch that was assumed is finished; an elastic one always is.
// Links: contact.c solves for their forces exactly about each linearisation. Both are consistent,
// so the two together are Newton's method on all unknowns.
//
// Work on floors is done in flat loops, those of floors.c where all but the links is linear, else
// those of chain.c; work on links is done for live ones only.
#include "solve/newmark/newmark.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "model/parts.h"
#include "solve/contact/contact.h"
#include "solve/forcing.h"

static void newmark_begin(struct work *w, const struct state *now, struct state *next, double end) {
    const struct model *m = w->model;
    contact_begin(w, now, next);
    next->time = end;
    if (w->forcing) {
        excitation_of_pieces(next, w->forcing, end);
    } else {
        excitation_grounds_known(&w->ahead, next, m, end);
        if (state_is_linear(m) && state_is_uniform(m)) {
            return;
        }
        excitation_floors(next, m, end);
    }
    if (m->elastic) {
        return;
    }
    memset(w->storeys.agree, 0, (size_t)m->n_building * sizeof *w->storeys.agree);
    memset(w->correction, 0, (size_t)m->n_dof * sizeof *w->correction);
}

// residual = external - M a - C v - storey shears - link forces, with the internal forces of
// `next`.
static void newmark_residuals(struct work *w, struct state *next, const double *a) {
    const struct model *m = w->model;
    chain_residual(&m->chain, next->external, a, next->damping_force, next->shear,
                   w->storeys.residual);
    state_add_link_forces(next, m, w->storeys.residual);
}

// How many buildings in a row, from k on, have storeys that do not agree yet.
static int newmark_disagreeing(const struct work *w, int k) {
    int n = 0;
    while (k + n < w->model->n_building && !w->storeys.agree[k + n]) {
        n++;
    }
    return n;
}

// Solves A dq = residual for the buildings whose storeys do not agree, and adds dq to their
// corrections.
static void newmark_solve_residuals(struct work *w) {
    const struct building *building = w->model->building;
    const struct storeys *s = &w->storeys;
    for (int k = 0; k < w->model->n_building; k++) {
        int n = newmark_disagreeing(w, k);
        int first = building[k].first;
        if (n == 0) {
            continue;
        }
        effective_solve(&w->effective[k], n, s->residual + first, s->change + first);
        k += n - 1;
        for (int i = first; i < building[k].first + building[k].n_floor; i++) {
            w->correction[i] += s->change[i];
        }
    }
}

// At the drifts of the solution, are the shears of building k those that their linearisation
// predicted? The displacement below a storey is that above less the drift.
LANES static bool newmark_agrees(const struct work *w, const struct state *next, int k) {
    const struct building *g = &w->model->building[k];
    const double *tangent = w->effective[k].tangent, *stiffness = g->stiffness;
    const double *u = next->u + g->first;
    const double *drift = next->drift + g->first, *drift_0 = w->storeys.drift + g->first;
    const double *shear = next->shear + g->first, *shear_0 = w->storeys.shear + g->first;
    const double tolerance = w->model->tolerance;
    long beyond = 0;
    for (int i = 0, n = g->n_floor; i < n; i++) {
        double predicted = shear_0[i] + tangent[i] * (drift[i] - drift_0[i]);
        double size = fabs(u[i] - drift[i]) + fabs(u[i]);
        double allowed = tolerance * fabs(shear[i]) + 8.0 * DBL_EPSILON * stiffness[i] * size;
        beyond |= !(fabs(shear[i] - predicted) <= allowed);
    }
    return beyond == 0;
}

// The same for a building with parts, whose shears depend on all its drifts and their rates.
static bool newmark_parts_agree(const struct work *w, const struct state *next, int k) {
    const struct building *g = &w->model->building[k];
    const struct storeys *from = &w->storeys;
    const int first = g->first, n = g->n_floor;
    const double *tangent = w->effective[k].tangent;
    const double *by_drift = tangent + n, *by_rate = by_drift + (size_t)n * (size_t)n;
    bool agree = true;
    for (int i = 0; i < n; i++, by_drift += n, by_rate += n) {
        double predicted = from->shear[first + i];
        double rounding = 0.0;
        for (int j = 0; j < n; j++) {
            const int at = first + j;
            const double stiffness = by_drift[j] + (j == i ? tangent[i] : 0.0);
            const double u = next->u[at], v = next->v[at];
            const double drift = next->drift[at], rate = next->rate[at];
            predicted +=
                stiffness * (drift - from->drift[at]) + by_rate[j] * (rate - from->rate[at]);
            rounding += fabs(stiffness) * (fabs(u - drift) + fabs(u)) +
                        fabs(by_rate[j]) * (fabs(v - rate) + fabs(v));
        }
        const double shear = next->shear[first + i];
        agree = agree && fabs(shear - predicted) <=
                             w->model->tolerance * fabs(shear) + 8.0 * DBL_EPSILON * rounding;
    }
    return agree;
}

static bool newmark_storeys_agree(struct work *w, const struct state *next) {
    bool all = true;
    if (w->model->elastic) {
        return true;
    }
    for (int k = 0; k < w->model->n_building; k++) {
        const struct building *g = &w->model->building[k];
        w->storeys.agree[k] = g->elastic || (g->n_part > 0 ? newmark_parts_agree(w, next, k)
                                                           : newmark_agrees(w, next, k));
        all &= w->storeys.agree[k];
    }
    return all;
}

// Takes the tangents of the parts of building k at the drifts of `at`.
static void newmark_linearise_parts(struct work *w, const struct state *now, const struct state *at,
                                    int k) {
    const struct building *g = &w->model->building[k];
    const size_t n = (size_t)g->n_floor;
    double *by_drift = w->effective[k].tangent + n;
    memset(by_drift, 0, 2 * n * n * sizeof *by_drift);
    parts_respond(g, now->storey_history, at->drift + g->first, at->rate + g->first,
                  &(struct part_sums){.by_drift = by_drift, .by_rate = by_drift + n * n}, NULL);
}

// Takes the tangents at the drifts of `at` for building k, and factorises again.
static int newmark_linearise(struct work *w, const struct state *now, const struct state *at,
                             int k) {
    const struct building *g = &w->model->building[k];
    const size_t size = (size_t)g->n_floor * sizeof *at->tangent;
    memcpy(w->effective[k].tangent, at->tangent + g->first, size);
    memcpy(w->memory->tangent + g->first, at->tangent + g->first, size);
    if (g->n_part > 0) {
        newmark_linearise_parts(w, now, at, k);
    }
    int status = effective_factor(&w->effective[k], w->b, w->g);
    w->h = status == STATUS_OK ? w->h : 0.0;
    return status;
}

// Does so for all buildings whose storeys did not agree.
static int newmark_relinearise(struct work *w, const struct state *now, const struct state *next) {
    int status = STATUS_OK;
    w->factors++;
    for (int k = 0; status == STATUS_OK && k < w->model->n_building; k++) {
        status = w->storeys.agree[k] ? STATUS_OK : newmark_linearise(w, now, next, k);
    }
    return status;
}

// The tangents of smooth laws change in every step. Those at the trial are close enough to those at
// the end of most steps.
static int newmark_linearise_smooth(struct work *w, const struct state *now,
                                    const struct state *trial) {
    const struct model *m = w->model;
    int status = STATUS_OK;
    for (int k = 0; status == STATUS_OK && k < m->n_building; k++) {
        if (m->building[k].smooth) {
            w->factors++;
            status = newmark_linearise(w, now, trial, k);
        }
    }
    return status;
}

// Solves for the forces of live links, which may make other links close.
static int newmark_solve_links(struct work *w, const struct state *now, struct state *next) {
    bool wanted = next->n_live > 0;
    while (contact_search(w, now, next) > 0 || wanted) {
        int status = contact_solve(w, now, next);
        if (status != STATUS_OK) {
            return status;
        }
        floors_correct_touched(w, now, next);
        wanted = false;
    }
    return STATUS_OK;
}

static int newmark_not_finite(const struct model *m, const struct state *s, struct error *e) {
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        for (int i = 0; i < g->n_floor; i++) {
            int j = g->first + i;
            if (!isfinite(s->u[j]) || !isfinite(s->v[j]) || !isfinite(s->a[j])) {
                return error_set(e, STATUS_FAILED,
                                 "the state is not finite at floor %d of building %s at t = %.9g",
                                 i + 1, g->name, s->time);
            }
        }
    }
    return error_set(e, STATUS_FAILED, "the state is not finite at t = %.9g", s->time);
}

// Keeps where the storeys were linearised, and takes the forces at the state reached.
static void newmark_take_forces(struct work *w, const struct state *now, struct state *next) {
    const struct model *m = w->model;
    memcpy(w->storeys.drift, next->drift, (size_t)m->n_dof * sizeof *next->drift);
    memcpy(w->storeys.shear, next->shear, (size_t)m->n_dof * sizeof *next->shear);
    memcpy(w->storeys.rate, next->rate, (size_t)m->n_dof * sizeof *next->rate);
    state_reach(next, m, next->u, next->v, now->storey_history);
}

// The shears of building g at drifts near those of `now`, by the tangents it is factorised with.
LANES static void newmark_predict_shears(const struct building *g, const double *tangent,
                                         const struct state *now, struct state *next) {
    const double *shear_0 = now->shear + g->first, *drift_0 = now->drift + g->first;
    const double *restrict drift = next->drift + g->first;
    double *restrict shear = next->shear + g->first;
    for (int i = 0; i < g->n_floor; i++) {
        shear[i] = shear_0[i] + tangent[i] * (drift[i] - drift_0[i]);
    }
}

// Internal forces at the trial. Storeys of straight lines most likely stay on theirs: the end of
// the step tells.
static void newmark_try_forces(struct work *w, const struct state *now, struct state *next) {
    const struct model *m = w->model;
    const double *history = now->storey_history;
    chain_forces(&m->chain, w->u_trial, w->v_trial, next->drift, next->shear, next->damping_force);
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        if (g->predictable) {
            newmark_predict_shears(g, w->effective[k].tangent, now, next);
        } else if (!g->elastic) {
            state_storeys(next, m, g, history, next->storey_history);
        }
    }
    state_full_forces(next, m, w->v_trial, history, next->storey_history);
}

// Newton's iteration on storeys and links. Leaves the internal forces of the state it finds.
static int newmark_solve(struct work *w, const struct state *now, struct state *next,
                         struct error *e) {
    const struct model *m = w->model;
    chain_trial(m->chain.n, w->h, now->u, now->v, now->a, w->u_trial, w->v_trial);
    newmark_try_forces(w, now, next);
    newmark_residuals(w, next, now->a);
    if (newmark_linearise_smooth(w, now, next) != STATUS_OK) {
        return STATUS_RETRY;
    }
    for (int i = 0; i < m->iterations; i++) {
        w->totals->iterations++;
        newmark_solve_residuals(w);
        if (!floors_correct(w, now, next, 0, m->chain.n)) {
            return newmark_not_finite(m, next, e);
        }
        gaps_update(&w->gaps, next);
        int status = newmark_solve_links(w, now, next);
        if (status != STATUS_OK) {
            return status;
        }
        newmark_take_forces(w, now, next);
        if (newmark_storeys_agree(w, next)) {
            return STATUS_OK;
        }
        newmark_residuals(w, next, next->a);
        if (newmark_relinearise(w, now, next) != STATUS_OK) {
            return STATUS_RETRY;
        }
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// The same where the floors are linear.
static int newmark_solve_linear(struct work *w, const struct state *now, struct state *next,
                                struct error *e) {
    w->totals->iterations++;
    if (!floors_move(w, now, next)) {
        return newmark_not_finite(w->model, next, e);
    }
    return newmark_solve_links(w, now, next);
}

// Completes the end of the step: internal forces where newmark_solve has not left them, total
// accelerations, and the histories of the links' laws.
static void newmark_finish(struct work *w, struct state *next) {
    const struct model *m = w->model;
    if (!state_is_linear(m)) {
        if (m->elastic) {
            state_internal_forces(next, m, next->u, next->v);
        }
        state_totals(next, m);
    }
    contact_finish(w, next);
}

int newmark_step(struct work *w, const struct state *now, struct state *next, double end, double h,
                 struct error *e) {
    if (work_factor(w, h) != STATUS_OK) {
        return STATUS_RETRY;
    }
    newmark_begin(w, now, next, end);
    int status =
        w->model->elastic ? newmark_solve_linear(w, now, next, e) : newmark_solve(w, now, next, e);
    if (status == STATUS_OK) {
        newmark_finish(w, next);
    }
    return status;
}
