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
//
// Resolved means ten steps in a contact of constant stiffness, k S h^2 <= (pi / 10)^2, and the
// decay that the dashpot of the law alone would cause, gamma h S dF/dv <= 1/2, at both ends of the
// step; S is the flexibility of the link. k is the slope of the law at v = 0: with v, Jankowski's
// is infinite at every closure.
#include "solve/contact/contact.h"

#include <float.h>
#include <math.h>

#include "core/number.h"
#include "law/link_law.h"
#include "solve/contact/sweep_step.h"

// Newton sweeps end, and block steps are tried, after so many sweeps, where the last one brought
// the change of the forces down by less than the factor SLOW.
enum { PLAIN_SWEEPS = 4 };

static const double SLOW = 0.2;

// After so many, laws are no longer allowed to pull.
enum { PULLING_SWEEPS = 25 };

// A closed contact whose penetration changes by less than this share, in fact and at its velocity,
// is at rest: the law is linear over such a step, and average acceleration preserves its energy.
static const double AT_REST = 0.1;

// A step is too long for a link that softens by more than this share of the effective stiffness.
static const double SOFTEST = -0.5;

// Velocity relative to the largest of any floor so far.
static const double NEGLIGIBLE = 1e-5;

// How a sweep gives links their forces.
enum sweep_kind {
    SWEEP_FIRST,   // Newton steps where they are safe, by groups of links that the cache holds
    SWEEP_NEWTON,  // the same
    SWEEP_EXACT,   // exact solutions
};

static void contact_sweep(struct work *w, const struct state *now, struct state *next,
                          enum sweep_kind kind, struct progress *s) {
    const int group = kind == SWEEP_FIRST ? SWEEP_GROUP : w->n_acting;
    sweep_renew(&w->model->tolerance, s);
    s->some_exact = false;
    if (kind == SWEEP_NEWTON) {
        sweep_evaluate_again(w, s);
    }
    for (int first = 0, end; first < w->n_acting; first = end) {
        end = first + group < w->n_acting ? first + group : w->n_acting;
        if (kind == SWEEP_FIRST) {
            sweep_gather(w, next, first, end, s);
        }
        for (int i = first; i < end; i++) {
            i = kind == SWEEP_EXACT ? i : sweep_newton(w, i, end, s);
            if (i < end) {
                exact_visit(w, now, next, w->acting[i], s);
            }
        }
    }
}

// A contact this slow is at rest, whatever the step does to it: its energy is 1e-10 of the floors'.
// Otherwise a body that bounces to rest would need ever shorter steps.
static bool contact_is_slow(const struct work *w, const struct state *now, double velocity) {
    return fabs(velocity) <= NEGLIGIBLE * floors_speed(w, now);
}

// Is a step short enough for a law that has the tangents `r` at d?
static bool contact_fits(const struct work *w, struct link_scratch *p, struct contact_response r,
                         double d) {
    bool short_enough = SWEEP_FITS_DASHPOT(w, p, r.dfdv);
    sweep_fit_spring(p, w->h, &r, &d, &short_enough);
    return short_enough;
}

static bool contact_resolved_at(const struct work *w, struct link_scratch *p, double d, double v) {
    double depth = number_max(d, 0.0);
    return contact_fits(w, p, p->law->force(p->constant, p->history, depth, v), depth);
}

// Is the step short enough for a link, or is there nothing to resolve because it is at rest? The
// start of the step was the end of the last one, and need not be looked at again where that was
// resolved with a step as long. A settled link has tangents already, taken close enough to the end.
static bool contact_judge(struct work *w, const struct state *now, const struct state *next,
                          struct link_scratch *p, double x, double d) {
    const int k = p->index;
    const bool was_closed = now->link[k].closed, is_closed = p->branch == BRANCH_CLOSED;
    const double d0 = now->delta[k], v = p->v_trial + w->g * x;
    const struct contact_response tangents = {.dfdd = p->dfdd, .dfdv = p->dfdv};
    bool resolved = !was_closed || p->resolved->step >= w->h ||
                    contact_resolved_at(w, p, d0, state_rate(now, w->model, k));
    if (resolved && is_closed) {
        resolved = p->stale ? contact_resolved_at(w, p, d, v) : contact_fits(w, p, tangents, d);
    }
    p->resolved->step = resolved ? w->h : 0.0;
    if (resolved) {
        return true;
    }
    const double v0 = state_rate(now, w->model, k);
    if (was_closed && is_closed) {
        const double allowed = AT_REST * fmin(d0, d), fastest = fmax(fabs(v0), fabs(v));
        return fabs(d - d0) <= allowed && fastest * w->h <= allowed;
    }
    return contact_is_slow(w, now, v) &&
           contact_is_slow(w, now, was_closed ? v0 : next->link[k].v_close);
}

// Has the force of a link at d one solution, also where the link softens? With the other links held
// it has one if 1 + beta h^2 S dF/dd > 0.
static bool contact_is_unique(const struct work *w, const struct link_scratch *p, double d) {
    return w->b * p->flexibility * p->law->force(p->constant, p->history, d, 0.0).dfdd >= SOFTEST;
}

// Is the step short enough for a bilateral link at d? One that becomes tight or loose in the step
// is like a contact that closes or opens.
static bool contact_link_fits(const struct work *w, const struct state *now,
                              const struct link_scratch *p, double d) {
    if (!(p->law->traits & CONTACT_TURNS)) {
        return true;
    }
    const double before = now->link[p->index].force, after = p->force;
    const bool stays = (before > 0.0) == (after > 0.0) && (before < 0.0) == (after < 0.0);
    const double coarse = p->constant[LINK_STIFFNESS] * p->flexibility * w->h * w->h;
    return contact_is_unique(w, p, d) &&
           (stays || !link_law_is_slack(p->constant) || coarse <= SWEEP_COARSEST_SPRING ||
            contact_is_slow(w, now, state_rate(now, w->model, p->index)));
}

// A contact of stiffness k lasts pi sqrt(m / k). Over a step longer than that, average acceleration
// gives a body back more energy than it brought (up to 1.8 times its velocity), and a few such
// impacts make nonsense of a run. True if the trial step from `now` to `next` resolves the contact,
// or if there is nothing to resolve because it is pressed together and hardly moves; else
// memory.unresolved says that it needs a shorter step. In the usual case the start has been
// checked, the end has its tangents, and the spring is no stiffer than one that has been checked.
static bool contact_resolves(struct work *w, const struct state *now, const struct state *next,
                             struct link_scratch *p) {
    const double x = sweep_across(p, w->correction), d = p->d_trial + w->b * x;
    if (p->resolved->step >= w->h && !p->stale && d <= p->resolved->depth &&
        SWEEP_FITS_DASHPOT(w, p, p->dfdv)) {
        p->resolved->step = w->h;
        return true;
    }
    const bool resolved = p->bilateral ? contact_link_fits(w, now, p, d)
                                       : p->law->rebound || contact_judge(w, now, next, p, x, d);
    w->memory->unresolved = resolved ? w->memory->unresolved : p->index;
    return resolved;
}

// Would another sweep change next to nothing? One of Newton steps measures that against the largest
// force of the sweep before, which may have been much larger.
static bool contact_converged(const struct work *w, enum sweep_kind kind,
                              const struct progress *s) {
    const double *tolerance = &w->model->tolerance;
    double feedback = w->n_acting == 1 ? 0.0 : s->some_exact ? 1.0 : number_min(s->feedback, 1.0);
    bool settled, measured;
    sweep_settled(s, tolerance, &feedback, &settled);
    sweep_measured(s, tolerance, &measured);
    return settled && (kind == SWEEP_EXACT || measured);
}

// Rounding error that the forces of other links cause in x (n_dof).
static double contact_rounding(const struct work *w, const double *x) {
    double largest = 0.0;
    for (int i = 0; i < w->gaps.n_touched; i++) {
        const struct building *g = &w->model->building[w->gaps.touched[i]];
        for (int j = g->first; j < g->first + g->n_dof; j++) {
            largest = number_max(largest, fabs(x[j]));
        }
    }
    return 16.0 * DBL_EPSILON * largest;
}

// Sweeps, with block steps between them once plain sweeps are too slow. *counter becomes that of
// the totals which counts solutions by the means that were needed.
static int contact_iterate(struct work *w, const struct state *now, struct state *next,
                           long **counter) {
    struct progress s;
    double before = INFINITY;
    enum sweep_kind kind = SWEEP_FIRST;
    w->others_d = w->others_v = 0.0;
    sweep_begin(w, next, &s);
    for (int i = 0; i < w->model->iterations; i++) {
        contact_sweep(w, now, next, kind, &s);
        w->totals->iterations++;
        if (contact_converged(w, kind, &s)) {
            return STATUS_OK;
        }
        if (i == PLAIN_SWEEPS) {
            // Is the step short enough? Checked early, so that one that is not costs little.
            for (int k = 0; k < w->n_acting && w->strictness == STEP_STRICT; k++) {
                if (!contact_resolves(w, now, next, w->acting[k])) {
                    return STATUS_RETRY;
                }
            }
            w->others_d = contact_rounding(w, w->u_trial);
            w->others_v = contact_rounding(w, w->v_trial);
        }
        if (i + 1 == PLAIN_SWEEPS) {
            cluster_find(&w->clusters, w->model, next);
        }
        // With laws that pull there may be no solution, or several between which sweeps go to and
        // fro. Without their tension there is just one.
        for (int k = 0; k < w->n_acting && i == PULLING_SWEEPS; k++) {
            struct link_scratch *p = w->acting[k];
            p->clamped = !p->bilateral && (p->law->traits & CONTACT_MAY_PULL);
        }
        const double change = number_max(s.moved[LAW_UNKNOWN], s.moved[LAW_KNOWN]);
        const bool slow = i + 1 >= PLAIN_SWEEPS && change > SLOW * before;
        if (slow) {
            bool blocked = cluster_steps(w, now, next) || *counter == &w->totals->block;
            *counter = blocked ? &w->totals->block : &w->totals->scalar;
        }
        kind = slow || i >= PULLING_SWEEPS || kind == SWEEP_EXACT ? SWEEP_EXACT : SWEEP_NEWTON;
        before = change;
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// Stores the force found for a link. A link whose law would pull if it were allowed to has neither
// an open nor a closed solution. False: the step is too long, or there is no solution, so that the
// link opens inside the step, and it has not bounced to rest.
static bool contact_take(struct work *w, const struct state *now, struct state *next,
                         struct link_scratch *p) {
    int k = p->index;
    bool strict = w->strictness == STEP_STRICT;
    if (strict && !contact_resolves(w, now, next, p)) {
        return false;
    }
    if (p->clamped && p->force == 0.0 && p->branch == BRANCH_CLOSED) {
        struct equation e = exact_equation(w, now, next, k);
        e.clamped = false;
        p->branch = exact_law(&e, 0.0).force < 0.0 ? BRANCH_NONE : BRANCH_CLOSED;
    }
    next->link[k].force = p->force;
    next->link[k].closed = p->branch != BRANCH_OPEN;
    if (next->link[k].closed != now->link[k].closed) {
        w->toggled[w->n_toggled++] = k;
    }
    return !strict || p->branch != BRANCH_NONE ||
           contact_is_slow(w, now, state_rate(now, w->model, k));
}

int contact_solve(struct work *w, const struct state *now, struct state *next) {
    long *counter = &w->totals->fast;
    int status = contact_iterate(w, now, next, &counter);
    w->n_toggled = 0;
    for (int i = 0; i < w->n_acting && status == STATUS_OK; i++) {
        status = contact_take(w, now, next, w->acting[i]) ? STATUS_OK : STATUS_RETRY;
    }
    *counter += status == STATUS_OK;
    return status;
}
