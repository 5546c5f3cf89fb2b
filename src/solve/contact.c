// SPDX-License-Identifier: GPL-3.0-or-later
// The contact iteration.
//
// With A the effective masses and B the links' directions, accelerations are a = a_free - A^-1 B'
// f, so that link l sees d_l = d_free,l - beta h^2 (S f)_l and v_l = v_free,l - gamma h (S f)_l
// with the flexibility S = B A^-1 B'. S is never formed: a column of A^-1 carries each change of a
// force into the accelerations. A sweep gives every active link its exact answer (line.c) with the
// others held, which is coordinate descent on a convex function where laws do not pull, and so
// converges whatever the step. Where it is slow, because stiff links share a floor, a block Newton
// step (block.c) is put between sweeps, and kept only if it halves the error.
//
// Converged: in one sweep no force changes by more than the tolerance relative to the largest, or
// the change moves the link by less than the rounding of its displacements. The latter keeps
// grazing contacts, whose force is all rounding, from iterating for ever.
#include "solve/contact.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "solve/block.h"
#include "solve/crossing.h"
#include "solve/resolve.h"

// A rigid contact at rest is held by its velocity, as holding d = 0 would make the force oscillate;
// in each step it gives back this share of what rounding and the ground motion let it stray from
// d = 0. Any share between 0 and 1 is stable: d[n+1] = d[n] - share (d[n] + d[n-1]) / 2.
static const double RECOVERY = 0.5;

// Sweeps before block steps are tried.
enum { PLAIN_SWEEPS = 4 };

// Relative trial acceleration of the two ends.
static double relative_acceleration(const struct link *l, const double *a) {
    double left = l->dof[0] == WALL ? 0.0 : a[l->dof[0]];
    double right = l->dof[1] == WALL ? 0.0 : a[l->dof[1]];
    return left - right;
}

// Acceleration of the link's ends towards each other per unit of its force, negative: S_ll.
static double own_flexibility(struct work *w, const struct link *l) {
    double sum = 0.0;
    for (int i = 0; i < 2; i++) {
        if (l->dof[i] != WALL) {
            sum +=
                effective_column(&w->effective[l->building[i]], l->floor[i] - 1)[l->floor[i] - 1];
        }
    }
    return sum;
}

static double trial_penetration(const struct work *w, const struct state *next, int k) {
    const struct link *l = &w->model->link[k];
    return state_gap(l, w->model, w->u_predicted, next->ground_u) - l->gap +
           w->b * relative_acceleration(l, next->a);
}

static double trial_rate(const struct work *w, const struct state *next, int k) {
    const struct link *l = &w->model->link[k];
    return state_gap(l, w->model, w->v_predicted, next->ground_v) +
           w->g * relative_acceleration(l, next->a);
}

struct line contact_line(struct work *w, const struct state *now, const struct state *next, int k) {
    const struct link *l = &w->model->link[k];
    double s = own_flexibility(w, l);
    return (struct line){
        .link = l,
        .history = next->link_history + l->history,
        .d_free = trial_penetration(w, next, k) + w->b * s * next->force[k],
        .v_free = trial_rate(w, next, k) + w->g * s * next->force[k],
        .d_force = w->b * s,
        .v_force = w->g * s,
        .v_rest = -RECOVERY * now->delta[k] / w->h,
        .v_rounding = l->law->rebound ? state_rounding(l, w->v_predicted) : 0.0,
        .closed = now->closed[k],
        .held = now->closed[k] && k == w->held,
    };
}

void contact_apply(struct work *w, struct state *next, int k, double df) {
    const struct link *l = &w->model->link[k];
    next->force[k] += df;
    for (int i = 0; i < 2; i++) {
        if (l->dof[i] == WALL) {
            continue;
        }
        const struct building *g = &w->model->building[l->building[i]];
        const double *column = effective_column(&w->effective[l->building[i]], l->floor[i] - 1);
        double push = i == 0 ? -df : df;
        for (int j = 0; j < g->n_floor; j++) {
            next->a[g->first + j] += push * column[j];
        }
    }
}

// Takes link k into the active ones. One that closes gets its velocity at the instant of closure,
// from its path without its own force, and the law's history from that.
static void activate(struct work *w, const struct state *now, struct state *next, int k) {
    const struct link *l = &w->model->link[k];
    w->is_active[k] = true;
    w->active[w->n_active++] = k;
    w->branch[k] = BRANCH_OPEN;
    double *history = next->link_history + l->history;
    if (now->closed[k]) {
        memcpy(history, now->link_history + l->history,
               (size_t)l->law->n_history * sizeof *history);
        return;
    }
    struct line line = contact_line(w, now, next, k);
    struct path path = {fmin(now->delta[k], 0.0), now->rate[k], line.d_free, line.v_free, w->h};
    double rate;
    next->t_close[k] = now->time + crossing_find(&path, &rate);
    next->v_close[k] = fmax(rate, 0.0);
    if (l->law->close) {
        l->law->close(l->constant, next->v_close[k], history);
    }
}

// Does an open link close in this step? One that has just opened may stand a rounding error inside;
// it closes only if it goes deeper. Rigid contacts close by an event.
static bool closes(const struct work *w, const struct state *now, const struct state *next, int k) {
    return k != w->held && !w->model->link[k].law->rebound &&
           trial_penetration(w, next, k) > fmax(now->delta[k], 0.0);
}

// Activates every link that is closed, bilateral or closing; returns how many were new.
static int search(struct work *w, const struct state *now, struct state *next) {
    int before = w->n_active;
    for (int k = 0; k < w->model->n_link; k++) {
        if (!w->is_active[k] && (now->closed[k] || closes(w, now, next, k))) {
            activate(w, now, next, k);
        }
    }
    return w->n_active - before;
}

// True if changing the force by df moves the link by no more than rounding.
static bool negligible(const struct work *w, const struct line *l, double df) {
    double moved = l->d_force > 0.0 ? l->d_force : l->v_force;
    const double *x = l->d_force > 0.0 ? w->u_predicted : w->v_predicted;
    return moved * fabs(df) <= state_rounding(l->link, x) + 4.0 * DBL_EPSILON * l->link->gap;
}

// One sweep of exact answers. True if it changed nothing that matters.
static bool sweep(struct work *w, const struct state *now, struct state *next) {
    double largest = 0.0;
    double change = 0.0;
    for (int i = 0; i < w->n_active; i++) {
        int k = w->active[i];
        struct line line = contact_line(w, now, next, k);
        double force;
        w->branch[k] = line_answer(&line, next->force[k], &force);
        double df = force - next->force[k];
        contact_apply(w, next, k, df);
        next->force[k] = force;
        largest = fmax(largest, fabs(force));
        change = fmax(change, negligible(w, &line, df) ? 0.0 : fabs(df));
    }
    w->totals->iterations++;
    return change <= w->model->tolerance * largest;
}

// Sweeps, with block steps between them once plain sweeps are too slow.
static int iterate(struct work *w, const struct state *now, struct state *next, bool *blocked) {
    for (int i = 0; i < w->model->iterations; i++) {
        bool converged = sweep(w, now, next) || w->n_active == 1;
        bool judged = w->strictness == STEP_STRICT && (i == 0 || converged);
        if (judged && !resolve_suffices(w, now, next)) {
            return STATUS_RETRY;
        }
        if (converged) {
            return STATUS_OK;
        }
        if (i + 1 >= PLAIN_SWEEPS && block_step(w, now, next)) {
            *blocked = true;
        }
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// A link that found neither an open nor a closed solution opens inside the step, unless it has
// bounced to rest.
static bool undecided(const struct work *w, const struct state *now) {
    for (int i = 0; w->strictness == STEP_STRICT && i < w->n_active; i++) {
        int k = w->active[i];
        if (w->branch[k] == BRANCH_NONE && !resolve_negligible(w, now->rate[k])) {
            return true;
        }
    }
    return false;
}

int contact_solve(struct work *w, const struct state *now, struct state *next) {
    bool blocked = false;
    long before = w->totals->iterations;
    if (search(w, now, next) == 0 && w->n_active == 0) {
        return STATUS_OK;
    }
    do {
        int status = iterate(w, now, next, &blocked);
        if (status != STATUS_OK) {
            return status;
        }
    } while (search(w, now, next) > 0);
    if (undecided(w, now)) {
        return STATUS_RETRY;
    }
    long sweeps = w->totals->iterations - before;
    *(blocked ? &w->totals->block : sweeps > 2 ? &w->totals->scalar : &w->totals->fast) += 1;
    return STATUS_OK;
}
