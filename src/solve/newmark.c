// SPDX-License-Identifier: GPL-3.0-or-later
// Newmark (1959), J. Eng. Mech. Div. ASCE 85(3), 67-94. With the accelerations at the end of the
// step as unknowns,
//     u = u_p + beta h^2 a,   u_p = u_n + h v_n + h^2 (1/2 - beta) a_n,
//     v = v_p + gamma h a,    v_p = v_n + h (1 - gamma) a_n,
// equilibrium M a + C v + f_s(u) + B' f = p is solved at the end of the step. This form serves any
// beta >= 0, and loses no digits for small steps, where A = M + gamma h C + beta h^2 K -> M.
//
// Storeys: Newton with their consistent tangents, building by building; a building whose storeys
// turn out to be on the branch that was assumed is settled, and an elastic one always is. Links:
// contact.c solves them exactly about each linearisation. Both are consistent, so the two together
// are Newton's method on all unknowns.
#include "solve/newmark.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "solve/contact.h"
#include "solve/excitation.h"

static void predict(struct work *w, const struct state *now, struct state *next) {
    const struct model *m = w->model;
    double h = w->h;
    double half = h * h * (0.5 - m->beta);
    double rest = h * (1.0 - m->gamma);
    for (int i = 0; i < m->n_dof; i++) {
        w->u_predicted[i] = now->u[i] + h * now->v[i] + half * now->a[i];
        w->v_predicted[i] = now->v[i] + rest * now->a[i];
        next->a[i] = now->a[i];
    }
}

static void begin(struct work *w, const struct state *now, struct state *next, double end) {
    const struct model *m = w->model;
    next->time = end;
    predict(w, now, next);
    excitation_at(next, m, end);
    memcpy(next->storey_history, now->storey_history,
           (size_t)m->n_storey_history * sizeof *next->storey_history);
    memcpy(next->force, now->force, (size_t)m->n_link * sizeof *next->force);
    memcpy(next->t_close, now->t_close, (size_t)m->n_link * sizeof *next->t_close);
    memcpy(next->v_close, now->v_close, (size_t)m->n_link * sizeof *next->v_close);
    memset(w->settled, 0, (size_t)m->n_building * sizeof *w->settled);
    memset(w->is_active, 0, (size_t)m->n_link * sizeof *w->is_active);
    w->n_active = 0;
}

static void kinematics(const struct work *w, struct state *next) {
    for (int i = 0; i < w->model->n_dof; i++) {
        next->u[i] = w->u_predicted[i] + w->b * next->a[i];
        next->v[i] = w->v_predicted[i] + w->g * next->a[i];
    }
}

// residual = external - M a - C v - storey shears - link forces
static void residuals(struct work *w, const struct state *next) {
    const struct model *m = w->model;
    for (int k = 0; k < m->n_building; k++) {
        const struct building *g = &m->building[k];
        const double *shear = next->shear + g->first;
        double *r = w->residual + g->first;
        for (int i = 0; i < g->n_floor; i++) {
            int j = g->first + i;
            double above = i + 1 < g->n_floor ? shear[i + 1] : 0.0;
            r[i] = next->external[j] - g->mass[i] * next->a[j] - next->damping_force[j] - shear[i] +
                   above;
        }
    }
    for (int k = 0; k < m->n_link; k++) {
        const int *dof = m->link[k].dof;
        if (next->force[k] != 0.0 && dof[0] != WALL) {
            w->residual[dof[0]] -= next->force[k];
        }
        if (next->force[k] != 0.0 && dof[1] != WALL) {
            w->residual[dof[1]] += next->force[k];
        }
    }
}

// Adds A^-1 residual to the accelerations of the buildings that are not settled.
static void correct(struct work *w, struct state *next) {
    for (int k = 0; k < w->model->n_building; k++) {
        if (w->settled[k]) {
            continue;
        }
        const struct building *g = &w->model->building[k];
        double *r = w->residual + g->first;
        effective_solve(&w->effective[k], r);
        for (int i = 0; i < g->n_floor; i++) {
            next->a[g->first + i] += r[i];
        }
    }
}

// Do the storeys of building k bear, at the drifts that the solution found, the shears that their
// linearisation predicted?
static bool agrees(const struct work *w, const struct state *next, int k) {
    const struct building *g = &w->model->building[k];
    const double *tangent = w->effective[k].tangent;
    double below = 0.0;
    for (int i = 0; i < g->n_floor; i++) {
        int j = g->first + i;
        const struct storey *s = &w->model->storey[j];
        double drift = next->u[j] - below;
        double predicted = next->shear[j] + tangent[i] * (drift - next->drift[j]);
        double shear = s->law->shear(s->constant, next->storey_history + s->history, drift).shear;
        double rounding = 8.0 * DBL_EPSILON * g->stiffness[i] * (fabs(below) + fabs(next->u[j]));
        if (!(fabs(shear - predicted) <= w->model->tolerance * fabs(shear) + rounding)) {
            return false;
        }
        below = next->u[j];
    }
    return true;
}

static bool settle(struct work *w, const struct state *next) {
    bool all = true;
    for (int k = 0; k < w->model->n_building; k++) {
        w->settled[k] = w->model->building[k].elastic || agrees(w, next, k);
        all &= w->settled[k];
    }
    return all;
}

// Takes the tangents at the trial drifts of the buildings that are not settled, and factorises
// again.
static int relinearise(struct work *w, const struct state *next) {
    const struct model *m = w->model;
    for (int k = 0; k < m->n_building; k++) {
        if (w->settled[k]) {
            continue;
        }
        const struct building *g = &m->building[k];
        for (int i = 0; i < g->n_floor; i++) {
            const struct storey *s = &m->storey[g->first + i];
            w->effective[k].tangent[i] = s->law
                                             ->shear(s->constant, next->storey_history + s->history,
                                                     next->drift[g->first + i])
                                             .tangent;
        }
        int status = effective_factor(&w->effective[k], w->b, w->g);
        if (status != STATUS_OK) {
            w->h = 0.0;
            return status;
        }
    }
    return STATUS_OK;
}

// Newton's iteration on storeys and links.
static int solve(struct work *w, const struct state *now, struct state *next) {
    for (int i = 0; i < w->model->iterations; i++) {
        kinematics(w, next);
        state_internal_forces(next, w->model);
        if (i > 0 && relinearise(w, next) != STATUS_OK) {
            return STATUS_RETRY;
        }
        residuals(w, next);
        correct(w, next);
        w->totals->iterations++;
        int status = contact_solve(w, now, next);
        if (status != STATUS_OK) {
            return status;
        }
        kinematics(w, next);
        if (settle(w, next)) {
            return STATUS_OK;
        }
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

static void finish_links(struct work *w, struct state *next) {
    const struct model *m = w->model;
    for (int k = 0; k < m->n_link; k++) {
        const struct link *l = &m->link[k];
        next->delta[k] = state_gap(l, m, next->u, next->ground_u) - l->gap;
        next->rate[k] = state_gap(l, m, next->v, next->ground_v);
        next->closed[k] = w->is_active[k] && w->branch[k] != BRANCH_OPEN;
        if (next->closed[k] && l->law->commit) {
            l->law->commit(l->constant, next->link_history + l->history, fmax(next->delta[k], 0.0),
                           next->rate[k]);
        }
    }
}

// Everything else that belongs to the end of the step: forces, and the histories of the laws.
static void finish(struct work *w, struct state *next) {
    const struct model *m = w->model;
    state_internal_forces(next, m);
    for (int i = 0; m->n_storey_history > 0 && i < m->n_dof; i++) {
        const struct storey *s = &m->storey[i];
        if (s->law->commit) {
            s->law->commit(s->constant, next->storey_history + s->history, next->drift[i]);
        }
    }
    finish_links(w, next);
}

static int check_finite(struct work *w, const struct state *s, struct error *e) {
    const struct model *m = w->model;
    double sum = 0.0;
    for (int i = 0; i < m->n_dof; i++) {
        double speed = fabs(s->v[i]);
        sum += fabs(s->u[i]) + speed + fabs(s->a[i]);
        w->speed = speed > w->speed ? speed : w->speed;
    }
    if (isfinite(sum)) {
        return STATUS_OK;
    }
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

int newmark_step(struct work *w, const struct state *now, struct state *next, double end, double h,
                 struct error *e) {
    if (work_factor(w, h) != STATUS_OK) {
        return STATUS_RETRY;
    }
    begin(w, now, next, end);
    int status = solve(w, now, next);
    if (status != STATUS_OK) {
        return status;
    }
    finish(w, next);
    return check_finite(w, next, e);
}
