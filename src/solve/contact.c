// SPDX-License-Identifier: GPL-3.0-or-later
// The contact iteration.
//
// With A the effective masses and B the links' directions, accelerations are a = a_free - A^-1 B'
// f, so that link l sees d_l = d_free,l - beta h^2 (S f)_l and v_l = v_free,l - gamma h (S f)_l
// with the flexibility S = B A^-1 B'. S is never formed: a column of A^-1 carries each change of a
// force into the accelerations. Quick sweeps (quick.c) take Newton steps, link by link, and give a
// link its exact answer (line.c) with the others held where such a step is not safe; they do as
// long as changes shrink fast. From then on every link gets its exact answer in each sweep, which
// is coordinate descent on a convex function where laws do not pull, and so converges whatever the
// step. Where it is slow, because stiff links share a floor, a block Newton step (block.c) is put
// between sweeps, and kept only if it halves the error.
//
// Converged: another sweep would change no force by more than the tolerance relative to the
// largest, or the change moves the link by less than the rounding of its displacements. The latter
// keeps grazing contacts, whose force is all rounding, from iterating for ever.
#include "solve/contact.h"

#include <float.h>
#include <math.h>

#include "core/number.h"
#include "solve/block.h"
#include "solve/quick.h"
#include "solve/resolve.h"

// A rigid contact at rest is held by its velocity, as holding d = 0 would make the force oscillate;
// in each step it gives back this share of what rounding and the ground motion let it stray from
// d = 0. That is stable for every share up to 1 where 2 beta <= gamma, and else for none if gamma
// is 1/2 (eigenvalues of the recursion for d, v and a); then nothing is given back.
static const double RECOVERY = 0.5;

// Quick sweeps end, and block steps are tried, after so many sweeps, where the last one brought the
// change of the forces down by less than the factor SLOW.
enum { PLAIN_SWEEPS = 4 };
static const double SLOW = 0.2;

// After so many, laws are no longer let pull.
enum { PULLING_SWEEPS = 25 };

// Changes of a force less than this share of it may come from the rounding of others.
static const double SMALL = 1e-8;

static double ends_difference(const struct quick *p, const double *x) {
    return x[p->end[0]] - x[p->end[1]];
}

static double recovery(const struct model *m) {
    return 2.0 * m->beta <= m->gamma ? RECOVERY : 0.0;
}

struct line contact_line(struct work *w, const struct state *now, const struct state *next, int k) {
    const struct quick *p = &w->quick[k];
    const struct link *l = p->link;
    double s = p->flexibility;
    double corrected = ends_difference(p, w->correction) + s * p->force;
    return (struct line){
        .link = l,
        .history = next->link_history + l->history,
        .d_free = ends_difference(p, w->u_trial) - l->gap + w->b * corrected +
                  state_ground_gap(l, w->model, next->ground_u),
        .v_free = ends_difference(p, w->v_trial) + w->g * corrected +
                  state_ground_gap(l, w->model, next->ground_v),
        .d_force = w->b * s,
        .v_force = w->g * s,
        .v_rest = -recovery(w->model) * now->delta[k] / w->h,
        .v_rounding = l->law->rebound ? state_rounding(l, w->v_trial) : 0.0,
        .closed = now->link[k].closed,
        .clamped = p->clamped,
        .held = now->link[k].closed && k == w->held,
    };
}

void contact_apply(struct work *w, struct quick *p, double df) {
    p->force += df;
    quick_push(w, p, df);
}

// Rounding that the forces of other links bring into x (n_dof).
static double rounding_of_others(const struct work *w, const double *x) {
    double largest = 0.0;
    for (int i = 0; i < w->gaps.n_touched; i++) {
        const struct building *g = &w->model->building[w->gaps.touched[i]];
        for (int j = g->first; j < g->first + g->n_floor; j++) {
            largest = number_max(largest, fabs(x[j]));
        }
    }
    return 16.0 * DBL_EPSILON * largest;
}

// How much the force of a link changes with the rounding of its d and v.
static double noise(const struct line *l, enum branch branch, double f, double d, double v) {
    if (l->link->law->rebound || f == l->v_free / l->v_force) {
        return v / l->v_force;
    }
    if (branch == BRANCH_CLOSED) {
        struct contact_response r = line_law(l, f);
        double slope = l->d_force * r.dfdd + l->v_force * r.dfdv;
        double change = (fabs(r.dfdd) * d + fabs(r.dfdv) * v) / (1.0 + fabs(slope));
        if (isfinite(change)) {
            return change;
        }
    }
    return l->d_force > 0.0 ? d / l->d_force : 0.0;
}

// Is a change of the force no more than rounding? That of other links counts where it is small and
// sweeps take long.
static bool negligible(const struct work *w, const struct line *l, enum branch branch, double f,
                       double df) {
    double corrected = state_rounding(l->link, w->correction);
    double d =
        state_rounding(l->link, w->u_trial) + w->b * corrected + 4.0 * DBL_EPSILON * l->link->gap;
    double v = state_rounding(l->link, w->v_trial) + w->g * corrected;
    if (fabs(df) <= SMALL * fabs(f)) {
        d += w->others_d;
        v += w->others_v;
    }
    bool maybe = l->v_force * fabs(df) <= v || l->d_force * fabs(df) <= d;
    return maybe && fabs(df) <= noise(l, branch, f, d, v);
}

double contact_settle(struct work *w, const struct state *now, struct state *next, int k) {
    struct quick *p = &w->quick[k];
    struct line line = contact_line(w, now, next, k);
    double force;
    p->branch = line_answer(&line, p->force, &force);
    double df = force - p->force;
    quick_push(w, p, df);
    p->force = force;
    return df;
}

// Gives the link its exact answer. Newton steps may follow where the law leaves no choice between
// its branches.
static void answer(struct work *w, const struct state *now, struct state *next, struct quick *p,
                   struct progress *s) {
    int k = p->index;
    const struct contact_law *law = p->link->law;
    double df = contact_settle(w, now, next, k);
    bool jumps = law->traits & CONTACT_JUMPS;
    bool pulls = law->traits & CONTACT_MAY_PULL;
    p->trusted = p->branch == BRANCH_CLOSED && law->force && !p->clamped &&
                 (now->link[k].closed || !(jumps || pulls));
    p->open = p->branch == BRANCH_OPEN && law->force && !(now->link[k].closed && pulls);
    p->ask = true;
    s->answered = true;
    s->largest = number_max(s->largest, fabs(p->force));
    if (fabs(df) > s->change) {
        struct line line = contact_line(w, now, next, k);
        if (!negligible(w, &line, p->branch, p->force, df)) {
            s->change = fabs(df);
        }
    }
}

// How a sweep answers: exactly, or by Newton steps where they are safe.
enum answers { ANSWERS_EXACT, ANSWERS_NEWTON };

// `last` is the sweep before.
static struct progress sweep(struct work *w, const struct state *now, struct state *next,
                             enum answers answers, const struct progress *last) {
    struct progress s = {.enough = w->model->tolerance * last->largest,
                         .loosest = last->loosest,
                         .echo = last->echo,
                         .clear = INFINITY};
    if (answers == ANSWERS_NEWTON) {
        quick_ask(w, &s);
    }
    for (int i = 0;; i++) {
        i = answers == ANSWERS_NEWTON ? quick_sweep(w, i, &s) : i;
        if (i == w->n_acting) {
            w->totals->iterations++;
            return s;
        }
        answer(w, now, next, w->acting[i], &s);
    }
}

// Is it worth going on? Asked when the answer is there, and early, so that a hopeless step costs
// little.
static bool suffices(struct work *w, const struct state *now, const struct state *next) {
    return w->strictness == STEP_ACCEPT || resolve_suffices(w, now, next);
}

// With laws that pull there may be no solution, or several between which sweeps go to and fro.
// Without their tension there is just one.
static void clamp(struct work *w) {
    for (int i = 0; i < w->n_acting; i++) {
        struct quick *p = w->acting[i];
        p->clamped = !p->link->bilateral && (p->link->law->traits & CONTACT_MAY_PULL);
    }
}

// Block steps on all clusters; true if one was of use.
static bool block_steps(struct work *w, const struct state *now, struct state *next) {
    bool any = false;
    int n = cluster_find(w, next);
    for (int i = 0; i < n; i++) {
        struct cluster c = cluster_at(w, i);
        any |= c.n > 1 && block_step(w, now, next, &c, &w->nearest[i]);
    }
    return any;
}

// Largest change of a force in a sweep.
static double changed(const struct progress *s) {
    return number_max(s->change, s->moved);
}

// Would another sweep change next to nothing? If this one took Newton steps it measured that by the
// largest force of the sweep before, which may have been much larger.
static bool converged(const struct work *w, enum answers answers, const struct progress *s) {
    double tolerance = w->model->tolerance * s->largest;
    double echo = w->n_acting == 1 ? 0.0 : s->answered ? 1.0 : number_min(s->echo, 1.0);
    return s->change <= tolerance && echo * s->moved <= tolerance && !(s->moved > s->clear) &&
           (answers == ANSWERS_EXACT || s->enough <= 4.0 * tolerance);
}

// Sweeps, with block steps between them once plain sweeps are too slow. *counter is that of totals
// for what it took.
static int iterate(struct work *w, const struct state *now, struct state *next, long **counter) {
    struct progress last;
    quick_gather(w, next, &last);
    w->others_d = w->others_v = 0.0;
    for (int i = 0; i < w->model->n_building; i++) {
        w->nearest[i] = INFINITY;
    }
    enum answers answers = ANSWERS_NEWTON;
    for (int i = 0; i < w->model->iterations; i++) {
        struct progress s = sweep(w, now, next, answers, &last);
        bool done = converged(w, answers, &s);
        if ((done || i == PLAIN_SWEEPS) && !suffices(w, now, next)) {
            return STATUS_RETRY;
        }
        if (done) {
            return STATUS_OK;
        }
        if (i == PLAIN_SWEEPS) {
            w->others_d = rounding_of_others(w, w->u_trial);
            w->others_v = rounding_of_others(w, w->v_trial);
        }
        if (i == PULLING_SWEEPS) {
            clamp(w);
            answers = ANSWERS_EXACT;
        }
        if (i + 1 >= PLAIN_SWEEPS && changed(&s) > SLOW * changed(&last)) {
            answers = ANSWERS_EXACT;
            bool blocked = block_steps(w, now, next) || *counter == &w->totals->block;
            *counter = blocked ? &w->totals->block : &w->totals->scalar;
        }
        last = s;
    }
    w->totals->unsolved += w->strictness == STEP_ACCEPT;
    return w->strictness == STEP_ACCEPT ? STATUS_OK : STATUS_RETRY;
}

// A link whose law would pull where it was not let has neither an open nor a closed solution.
static enum branch judge_clamped(struct work *w, const struct state *now, const struct state *next,
                                 const struct quick *p) {
    if (!p->clamped || p->force != 0.0 || p->branch != BRANCH_CLOSED) {
        return p->branch;
    }
    struct line line = contact_line(w, now, next, p->index);
    line.clamped = false;
    return line_law(&line, 0.0).force < 0.0 ? BRANCH_NONE : BRANCH_CLOSED;
}

// Takes the forces that were found. A link that found neither an open nor a closed solution opens
// inside the step, unless it has bounced to rest; then false.
static bool decided(struct work *w, const struct state *now, struct state *next) {
    bool all = true;
    for (int i = 0; i < w->n_acting; i++) {
        struct quick *p = w->acting[i];
        next->link[p->index].force = p->force;
        p->branch = judge_clamped(w, now, next, p);
        if (p->branch == BRANCH_NONE && w->strictness == STEP_STRICT) {
            all &= resolve_negligible(w, state_rate(now, w->model, p->index));
        }
    }
    return all;
}

int contact_solve(struct work *w, const struct state *now, struct state *next) {
    long *counter = &w->totals->fast;
    int status = iterate(w, now, next, &counter);
    if (status != STATUS_OK) {
        return status;
    }
    if (!decided(w, now, next)) {
        return STATUS_RETRY;
    }
    *counter += 1;
    return STATUS_OK;
}
