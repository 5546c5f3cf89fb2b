// SPDX-License-Identifier: GPL-3.0-or-later
// The contact iteration.
//
// With A the effective masses and B the links' directions, accelerations are a = a_free - A^-1 B'
// f, so that link l has d_l = d_free,l - beta h^2 (S f)_l and v_l = v_free,l - gamma h (S f)_l
// with the flexibility S = B A^-1 B'. S is never formed: a column of A^-1 carries each change of a
// force into the accelerations. Newton sweeps (sweep.c) take Newton steps, link by link, and give a
// link its exact force (exact.c) with the others held where such a step is not safe. They go on as
// long as the changes shrink fast. From then on every link gets its exact force in each sweep,
// which is coordinate descent on a convex function where laws do not pull, and so converges for any
// step. Where that is slow, because stiff links share a floor, a block Newton step (cluster.c) is
// put between sweeps, and kept only if it halves the error.
//
// Converged: another sweep would change no force by more than the tolerance times the largest, or
// would move no link by more than the rounding error of its displacements (exact.c). The latter
// keeps grazing contacts, whose force is all rounding, from iterating for ever.
#include "solve/contact/contact.h"

#include <math.h>

#include "core/number.h"
#include "solve/contact/cluster.h"
#include "solve/contact/exact.h"
#include "solve/contact/resolve.h"
#include "solve/contact/sweep_step.h"

// Newton sweeps end, and block steps are tried, after so many sweeps, where the last one brought
// the change of the forces down by less than the factor SLOW.
enum { PLAIN_SWEEPS = 4 };

static const double SLOW = 0.2;

// After so many, laws are no longer allowed to pull.
enum { PULLING_SWEEPS = 25 };

// Goes over acting links `first` to end - 1: by exact solutions, or by Newton steps where they are
// safe.
static void contact_visit(struct work *w, const struct state *now, struct state *next, bool exact,
                          int first, int end, struct progress *s) {
    for (int i = first;; i++) {
        i = exact ? i : sweep_newton(w, i, end, s);
        if (i == end) {
            return;
        }
        exact_visit(w, now, next, w->acting[i], s);
    }
}

// The first sweep, by groups of links that the cache holds until they have been visited.
static void contact_first_sweep(struct work *w, const struct state *now, struct state *next,
                                struct progress *s) {
    sweep_begin(w, next, s);
    sweep_renew(&w->model->tolerance, s);
    for (int first = 0, end; first < w->n_acting; first = end) {
        end = first + SWEEP_GROUP < w->n_acting ? first + SWEEP_GROUP : w->n_acting;
        sweep_gather(w, next, first, end, s);
        contact_visit(w, now, next, false, first, end, s);
    }
}

static void contact_sweep(struct work *w, const struct state *now, struct state *next, bool exact,
                          struct progress *s) {
    sweep_renew(&w->model->tolerance, s);
    s->some_exact = false;
    if (!exact) {
        sweep_evaluate_again(w, s);
    }
    contact_visit(w, now, next, exact, 0, w->n_acting, s);
}

// Is the step short enough for all links? Checked early, so that one that is not costs little.
static bool contact_is_hopeful(struct work *w, const struct state *now, const struct state *next) {
    for (int i = 0; i < w->n_acting && w->strictness == STEP_STRICT; i++) {
        if (!resolve_suffices(w, now, next, w->acting[i])) {
            return false;
        }
    }
    return true;
}

// With laws that pull there may be no solution, or several between which sweeps go to and fro.
// Without their tension there is just one.
static void contact_clamp(struct work *w) {
    for (int i = 0; i < w->n_acting; i++) {
        struct link_scratch *p = w->acting[i];
        p->clamped = !p->link->bilateral && (p->link->law->traits & CONTACT_MAY_PULL);
    }
}

// Block steps on all clusters; true if one was of use.
static bool contact_block_steps(struct work *w, const struct state *now, struct state *next) {
    bool any = false;
    int n = cluster_find(&w->clusters, w->model, next);
    for (int i = 0; i < n; i++) {
        struct cluster c = cluster_at(&w->clusters, i);
        any |= c.n > 1 && cluster_step(w, now, next, &c, &w->clusters.nearest[i]);
    }
    return any;
}

// Largest change of a force in a sweep.
static double contact_change(const struct progress *s) {
    return number_max(s->moved[LAW_UNKNOWN], s->moved[LAW_KNOWN]);
}

// Would another sweep change next to nothing? One of Newton steps measures that against the largest
// force of the sweep before, which may have been much larger.
static bool contact_converged(const struct work *w, bool exact, const struct progress *s) {
    const double *tolerance = &w->model->tolerance;
    double feedback = w->n_acting == 1 ? 0.0 : s->some_exact ? 1.0 : number_min(s->feedback, 1.0);
    bool settled, measured;
    sweep_settled(s, tolerance, &feedback, &settled);
    sweep_measured(s, tolerance, &measured);
    return settled && (exact || measured);
}

// Sweeps, with block steps between them once plain sweeps are too slow. *counter becomes that of
// the totals which counts solutions by the means that were needed.
static int contact_iterate(struct work *w, const struct state *now, struct state *next,
                           long **counter) {
    struct progress s;
    double before = INFINITY;
    w->others_d = w->others_v = 0.0;
    for (int i = 0; i < w->model->n_building; i++) {
        w->clusters.nearest[i] = INFINITY;
    }
    bool exact = false;
    for (int i = 0; i < w->model->iterations; i++) {
        if (i == 0) {
            contact_first_sweep(w, now, next, &s);
        } else {
            contact_sweep(w, now, next, exact, &s);
        }
        w->totals->iterations++;
        if (contact_converged(w, exact, &s)) {
            return STATUS_OK;
        }
        if (i == PLAIN_SWEEPS) {
            if (!contact_is_hopeful(w, now, next)) {
                return STATUS_RETRY;
            }
            w->others_d = exact_rounding(w, w->u_trial);
            w->others_v = exact_rounding(w, w->v_trial);
        }
        if (i == PULLING_SWEEPS) {
            contact_clamp(w);
            exact = true;
        }
        if (i + 1 >= PLAIN_SWEEPS && contact_change(&s) > SLOW * before) {
            exact = true;
            bool blocked = contact_block_steps(w, now, next) || *counter == &w->totals->block;
            *counter = blocked ? &w->totals->block : &w->totals->scalar;
        }
        before = contact_change(&s);
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// A link whose law would pull if it were allowed to has neither an open nor a closed solution.
static enum branch contact_judge_clamped(struct work *w, const struct state *now,
                                         const struct state *next, const struct link_scratch *p) {
    if (!p->clamped || p->force != 0.0 || p->branch != BRANCH_CLOSED) {
        return p->branch;
    }
    struct equation e = exact_equation(w, now, next, p->index);
    e.clamped = false;
    return exact_law(&e, 0.0).force < 0.0 ? BRANCH_NONE : BRANCH_CLOSED;
}

// Stores the force found for a link. False: the step is too long, or there is neither an open nor a
// closed solution, so that the link opens inside the step, and it has not bounced to rest.
static bool contact_take(struct work *w, const struct state *now, struct state *next,
                         struct link_scratch *p) {
    int k = p->index;
    bool strict = w->strictness == STEP_STRICT;
    if (strict && !resolve_suffices(w, now, next, p)) {
        return false;
    }
    p->branch = contact_judge_clamped(w, now, next, p);
    next->link[k].force = p->force;
    next->link[k].closed = p->branch != BRANCH_OPEN;
    if (next->link[k].closed != now->link[k].closed) {
        w->toggled[w->n_toggled++] = k;
    }
    return !strict || p->branch != BRANCH_NONE ||
           resolve_negligible(w, now, state_rate(now, w->model, k));
}

static int contact_take_all(struct work *w, const struct state *now, struct state *next) {
    w->n_toggled = 0;
    for (int i = 0; i < w->n_acting; i++) {
        if (!contact_take(w, now, next, w->acting[i])) {
            return STATUS_RETRY;
        }
    }
    return STATUS_OK;
}

int contact_solve(struct work *w, const struct state *now, struct state *next) {
    long *counter = &w->totals->fast;
    int status = contact_iterate(w, now, next, &counter);
    status = status == STATUS_OK ? contact_take_all(w, now, next) : status;
    *counter += status == STATUS_OK;
    return status;
}
