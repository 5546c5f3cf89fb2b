// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark (1959), J. Eng. Mech. Div. ASCE 85(3), 67-94. The trial is the end of the step if the
// accelerations stayed, and q their correction:
//     u = u_t + beta h^2 q,   u_t = u_n + h v_n + h^2 a_n / 2,
//     v = v_t + gamma h q,    v_t = v_n + h a_n,                  a = a_n + q.
// Equilibrium M a + C v + f_s(u) + B' f = p is solved for q at the end of the step,
//     A q = p - M a_n - C v_t - f_s(u_t) - B' f,   A = M + gamma h C + beta h^2 K.
// This form holds for any beta >= 0, and loses no digits in small steps, where A -> M.
//
// Storeys: Newton's method with their consistent tangents. Each iteration takes the shears on their
// tangents back to the trial, and solves from there: so a step of yielding storeys is one of linear
// storeys whose shears at the trial are given. It is finished once the shears at its end are those
// that the tangents of all buildings foretold, as they are if all storeys stay on the branches that
// were assumed.
// Links: contact.c solves for their forces exactly about each linearisation. Both are consistent,
// so the two together are Newton's method on all unknowns.
//
// Work on floors is done in the flat loops of floors.c; work on links is done for live ones only.
#include "solve/newmark/newmark.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "core/lanes.h"
#include "model/parts.h"
#include "solve/contact/contact.h"
#include "solve/floors/floor_terms.h"
#include "solve/forcing.h"

static void newmark_begin(struct work *w, const struct state *now, struct state *next, double end) {
    const struct model *m = w->model;
    contact_begin(w, now, next);
    next->time = end;
    if (w->forcing) {
        forcing_of_pieces(next, w->forcing, end);
    } else {
        forcing_known(&w->ahead, next, m, end);
    }
}

// At the drifts of the solution, are the shears of n storeys without parts those that their
// linearisation predicted? The displacement below a storey is that above less the drift.
LANES static bool newmark_agrees(const struct work *w, const struct state *next, int first, int n) {
    const double *tangent = w->memory->tangent + first;
    const double *stiffness = w->model->chain.stiffness + first, *u = next->u + first;
    const double *drift = next->drift + first, *drift_0 = w->storeys.drift + first;
    const double *shear = next->shear + first, *shear_0 = w->storeys.shear + first;
    const double tolerance = w->model->tolerance;
    long beyond = 0;
    for (int i = 0; i < n; i++) {
        double predicted = shear_0[i] + tangent[i] * (drift[i] - drift_0[i]);
        double size = fabs(u[i] - drift[i]) + fabs(u[i]) + fabs(drift_0[i]);
        double allowed = tolerance * fabs(shear[i]) + 8.0 * DBL_EPSILON * stiffness[i] * size;
        beyond |= !(fabs(shear[i] - predicted) <= allowed);
    }
    return beyond == 0;
}

// The tangents of the shear of storey i by the drifts and the rates of storeys `first` to end - 1,
// of the parts of a building: by_drift[first] and so on. All others are 0.
struct newmark_row {
    int first, end;
    const double *by_drift, *by_rate;
};

static inline struct newmark_row newmark_row_of(const struct work *w, int k, int i) {
    const struct building *g = &w->model->building[k];
    const double *by_drift = w->effective[k].tangent + g->n_dof;
    const ptrdiff_t half = (building_n_tangent(g) - g->n_dof) / 2;
    const ptrdiff_t row = g->damping_full ? (ptrdiff_t)i * g->n_dof : 0;
    const int first = g->damping_full ? 0 : i, end = g->damping_full ? g->n_dof : i + 1;
    return (struct newmark_row){first, end, by_drift + row, by_drift + half + row};
}

// The same for a building with parts, whose shears depend on the drifts of others, and on rates.
static bool newmark_parts_agree(const struct work *w, const struct state *next, int k) {
    const struct building *g = &w->model->building[k];
    const struct storeys *from = &w->storeys;
    const int first = g->first;
    const double *tangent = w->effective[k].tangent;
    bool agree = true;
    for (int i = 0; i < g->n_dof; i++) {
        const struct newmark_row row = newmark_row_of(w, k, i);
        double predicted = from->shear[first + i];
        double rounding = 0.0;
        for (int j = row.first; j < row.end; j++) {
            const int at = first + j;
            const double stiffness = row.by_drift[j] + (j == i ? tangent[i] : 0.0);
            const double u = next->u[at], v = next->v[at];
            const double drift = next->drift[at], rate = next->rate[at];
            predicted +=
                stiffness * (drift - from->drift[at]) + row.by_rate[j] * (rate - from->rate[at]);
            rounding += fabs(stiffness) * (fabs(u - drift) + fabs(u) + fabs(from->drift[at])) +
                        fabs(row.by_rate[j]) * (fabs(v - rate) + fabs(v) + fabs(from->rate[at]));
        }
        const double shear = next->shear[first + i];
        agree = agree && fabs(shear - predicted) <=
                             w->model->tolerance * fabs(shear) + 8.0 * DBL_EPSILON * rounding;
    }
    return agree;
}

// Takes the tangents of the parts of building k at the drifts of `at`. STATUS_RETRY: a part has no
// equilibrium there.
static int newmark_linearise_parts(struct work *w, const struct state *now, const struct state *at,
                                   int k) {
    const struct building *g = &w->model->building[k];
    const size_t n = (size_t)(building_n_tangent(g) - g->n_dof), size = n * sizeof(double);
    double *by_drift = w->effective[k].tangent + g->n_dof;
    double *memory = w->memory->part_tangent + g->part_tangent;
    memset(by_drift, 0, size);
    const struct part_sums sums = {.diagonal = !g->damping_full,
                                   .by_drift = by_drift,
                                   .by_rate = by_drift + n / 2,
                                   .scratch = at->scratch};
    parts_respond(g, now->storey_history, at->drift + g->first, at->rate + g->first, &sums, NULL);
    const bool found = !isnan(by_drift[0]);
    w->lost = found ? w->lost : k;
    if (g->predictable) {
        memcpy(found ? memory : by_drift, found ? by_drift : memory, size);
    }
    return found ? STATUS_OK : STATUS_RETRY;
}

// Takes the tangents of the storeys of building k, and of its parts, at the drifts of `at`, and
// factorises again.
static int newmark_linearise(struct work *w, const struct state *now, const struct state *at,
                             int k) {
    const struct building *g = &w->model->building[k];
    const size_t n = (size_t)g->n_dof;
    double *tangent = w->effective[k].tangent;
    int status = STATUS_OK;
    memcpy(tangent, at->tangent + g->first, n * sizeof *tangent);
    memcpy(w->memory->tangent + g->first, at->tangent + g->first, n * sizeof *tangent);
    if (g->n_part > 0) {
        status = newmark_linearise_parts(w, now, at, k);
    }
    if (status == STATUS_OK) {
        status = effective_factor(&w->effective[k], w->b, w->g);
    }
    w->h = status == STATUS_OK ? w->h : 0.0;
    w->totals->indefinite += status != STATUS_OK;
    return status;
}

// Takes the shears of building k at a state to the trial, on the tangents it is factorised with.
LANES static void newmark_extrapolate(const struct work *w, const struct state *from, int k) {
    const struct building *g = &w->model->building[k];
    const int first = g->first;
    const double *tangent = w->effective[k].tangent, *trial = w->storeys.drift + first;
    const double *shear = from->shear + first, *drift = from->drift + first;
    double *restrict to = w->storeys.shear + first;
    for (int i = 0; i < g->n_dof; i++) {
        to[i] = shear[i] + tangent[i] * (trial[i] - drift[i]);
    }
    for (int i = 0; g->n_part > 0 && i < g->n_dof; i++) {
        const struct newmark_row row = newmark_row_of(w, k, i);
        for (int j = row.first; j < row.end; j++) {
            to[i] += row.by_drift[j] * (trial[j] - drift[j]) +
                     row.by_rate[j] * (w->storeys.rate[first + j] - from->rate[first + j]);
        }
    }
}

// Linearises the buildings again whose shears are not as foretold. STATUS_OK: there are none.
// STATUS_RETRY: a matrix is not positive definite.
static int newmark_relinearise(struct work *w, const struct state *now, const struct state *next,
                               bool *agree) {
    const struct model *m = w->model;
    *agree = !m->chain.parts && newmark_agrees(w, next, 0, m->chain.n);
    if (*agree) {
        return STATUS_OK;
    }
    *agree = true;
    for (int k = 0; k < m->n_body; k++) {
        const struct building *g = &m->building[k];
        if (g->elastic || (g->n_part > 0 ? newmark_parts_agree(w, next, k)
                                         : newmark_agrees(w, next, g->first, g->n_dof))) {
            continue;
        }
        w->factors += *agree;
        *agree = false;
        if (newmark_linearise(w, now, next, k) != STATUS_OK) {
            return STATUS_RETRY;
        }
        newmark_extrapolate(w, next, k);
    }
    return STATUS_OK;
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
    for (const struct building *g = m->building; g < m->building + m->n_body; g++) {
        for (int i = 0; i < g->n_dof; i++) {
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

// Drifts and elastic shears at the trial.
LANES static void newmark_strain(const struct chain *c, double h, const struct state *now,
                                 double *restrict drift, double *restrict shear) {
    const double *restrict u = now->u, *restrict v = now->v, *restrict a = now->a;
    const double *restrict k = c->stiffness, *restrict joint = c->joint;
    const double half = h * h / 2.0;
    for (int i = 0, n = lanes_rounded(c->n); i < n; i++) {
        const double under = TRIAL_U(u[i - 1], v[i - 1], a[i - 1], h, half);
        double d = TRIAL_U(u[i], v[i], a[i], h, half) - joint[i] * under;
        drift[i] = d;
        shear[i] = k[i] * d;
    }
}

// Drifts and shears at the trial. Storeys of straight lines most likely stay on theirs: the end of
// the step tells. The tangents of smooth laws change in every step; those at the trial are close
// enough to those at the end of most steps.
static int newmark_try(struct work *w, const struct state *now, const struct state *next) {
    const struct model *m = w->model;
    const double *history = now->storey_history;
    struct state trial = *next;
    int status = STATUS_OK;
    trial.drift = w->storeys.drift;
    trial.shear = w->storeys.shear;
    trial.rate = w->storeys.rate;
    newmark_strain(&m->chain, w->h, now, trial.drift, trial.shear);
    for (int k = 0; k < m->n_body; k++) {
        const struct building *g = &m->building[k];
        if (g->n_part > 0) {
            floors_trial(w, now, k);
            state_rates(&trial, g, w->v_trial);
        }
        if (g->predictable) {
            newmark_extrapolate(w, now, k);
        } else if (!g->elastic) {
            state_storeys(&trial, m, g, history, trial.storey_history);
        }
        if (g->n_part > 0 && !g->predictable) {
            state_parts(&trial, g, history, trial.storey_history);
        }
    }
    for (int k = 0; status == STATUS_OK && k < m->n_body; k++) {
        if (m->building[k].smooth) {
            w->factors++;
            status = newmark_linearise(w, now, &trial, k);
        }
    }
    return status;
}

// Newton's iteration on storeys and links. Where storeys yield, it leaves the internal forces of
// the state it finds.
static int newmark_solve(struct work *w, const struct state *now, struct state *next,
                         struct error *e) {
    const struct model *m = w->model;
    const double *shear = m->elastic ? NULL : w->storeys.shear;
    if (!m->elastic && newmark_try(w, now, next) != STATUS_OK) {
        return STATUS_RETRY;
    }
    for (int i = 0; i < m->iterations; i++) {
        w->totals->iterations++;
        if (!floors_move(w, now, next, shear)) {
            return newmark_not_finite(m, next, e);
        }
        int status = newmark_solve_links(w, now, next);
        if (status != STATUS_OK || m->elastic) {
            return status;
        }
        bool agree;
        state_forces(next, m, now->storey_history, next->storey_history);
        status = newmark_relinearise(w, now, next, &agree);
        if (status != STATUS_OK || agree) {
            return status;
        }
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// Completes the end of the step: internal forces where newmark_solve has not left them, and the
// histories of the links' laws.
static void newmark_finish(struct work *w, struct state *next) {
    if (w->model->elastic && !state_is_linear(w->model)) {
        state_forces(next, w->model, next->storey_history, NULL);
    }
    contact_finish(w, next);
}

int newmark_step(struct work *w, const struct state *now, struct state *next, double end, double h,
                 struct error *e) {
    w->lost = -1;
    if (work_factor(w, h) != STATUS_OK) {
        w->totals->indefinite++;
        return STATUS_RETRY;
    }
    newmark_begin(w, now, next, end);
    int status = newmark_solve(w, now, next, e);
    if (status == STATUS_OK) {
        newmark_finish(w, next);
    }
    return status;
}
